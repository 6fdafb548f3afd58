// SPDX-License-Identifier: Apache-2.0
#include "importers/stl/read/stl.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>
#include <unordered_map>

#include "importers/bytes/input_bytes.h"
#include "importers/bytes/text_cursor.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr std::size_t header = 84, facet = 50, normal = 12;  // bytes of a binary file

// Vertices that are told apart by their bits; 0 and −0 are one.
class Welded {
 public:
  void add(const std::array<Point3f, 3>& corners) {
    std::array<std::uint32_t, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = index(corners[i]);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
  }

  TriangleMesh mesh;

 private:
  struct Hash {
    std::size_t operator()(const Point3f& p) const {
      std::size_t h = 0;
      for (const float v : {p.x, p.y, p.z})
        h = (h ^ std::bit_cast<std::uint32_t>(v + 0.0f)) * std::size_t{0x9e3779b97f4a7c15u};
      return h ^ h >> 32;
    }
  };
  std::uint32_t index(Point3f p) {
    const auto [at, is_new] = indices_.try_emplace(p, static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) mesh.positions.push_back(p);
    return at->second;
  }

  std::unordered_map<Point3f, std::uint32_t, Hash> indices_;
};

std::uint32_t facets_of(const InputBytes& bytes) {
  std::array<unsigned char, 4> b{};
  std::memcpy(b.data(), bytes.begin() + header - 4, 4);
  return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 |
         std::uint32_t{b[3]} << 24;
}

bool is_binary(const InputBytes& bytes) {
  return bytes.size() >= header && bytes.size() == header + std::size_t{facets_of(bytes)} * facet;
}

TriangleMesh read_binary(const InputBytes& bytes, const std::string& name) {
  Welded welded;
  const std::uint32_t count = facets_of(bytes);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 9> v{};
    std::memcpy(v.data(), bytes.begin() + header + i * facet + normal, sizeof v);
    for (const float x : v)
      if (!std::isfinite(x)) throw Error(fmt::format("facet {} has a corner that is not finite", i), {name});
    welded.add({Point3f{v[0], v[1], v[2]}, Point3f{v[3], v[4], v[5]}, Point3f{v[6], v[7], v[8]}});
  }
  return std::move(welded.mesh);
}

float coordinate(TextCursor& text, const char* what) {
  const char* const begin = text.at();
  const auto value = static_cast<float>(text.number(what));
  if (!std::isfinite(value)) text.fail(fmt::format("{} is not finite", what), begin);
  return value;
}

TriangleMesh read_text(const InputBytes& bytes, const std::string& name) {
  TextCursor text(name, bytes.begin(), bytes.end());
  if (!text.skip_to_text() || text.word() != "solid")
    throw Error("this is no STL: it neither begins with \"solid\" nor has the size that it states",
                {name, 1});
  text.skip_line();
  Welded welded;
  std::array<Point3f, 3> corners{};
  std::size_t corner = 0;
  while (text.skip_to_text()) {
    const char* const begin = text.at();
    const std::string_view word = text.word();
    if (word == "vertex") {
      if (corner == 3) text.fail("a facet of more than three corners", begin);
      Point3f& p = corners[corner++];
      p.x = coordinate(text, "x"), p.y = coordinate(text, "y"), p.z = coordinate(text, "z");
    } else if (word == "endfacet") {
      if (corner != 3) text.fail("a facet of fewer than three corners", begin);
      welded.add(corners);
      corner = 0;
    } else if (word == "facet" || word == "solid" || word == "endsolid") {
      text.skip_line();  // a normal, which may be nan; a name
    } else if (word != "outer" && word != "loop" && word != "endloop") {
      text.fail(fmt::format("\"{}\" is no word of STL", printable(word)), begin);
    }
  }
  if (corner != 0) text.fail("the file ends within a facet");
  return std::move(welded.mesh);
}

}  // namespace

TriangleMesh read_stl(const std::filesystem::path& file) {
  const InputBytes bytes(file);
  return is_binary(bytes) ? read_binary(bytes, file.string()) : read_text(bytes, file.string());
}

}  // namespace vitrail
