// SPDX-License-Identifier: Apache-2.0
#include "importers/stl/read/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "importers/bytes/input_bytes.h"
#include "importers/bytes/text_cursor.h"
#include "importers/reading/named_file.h"
#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr std::size_t header = 84, facet = 50, normal = 12, corners_end = 48;  // bytes of a binary file

// Linear sRGB of three numbers of five bits, in sRGB's encoding.
using FacetColor = std::array<float, 3>;
FacetColor color_of(unsigned red, unsigned green, unsigned blue) {
  const auto decoded = [](unsigned v) { return static_cast<float>(srgb_decode((v & 31) / 31.0)); };
  return {decoded(red), decoded(green), decoded(blue)};
}

// The two bytes behind a facet have a colour where the highest bit is set (VisCAM, SolidView).
std::optional<FacetColor> color_of_viscam(unsigned bits) {
  if (!(bits & 0x8000)) return {};
  return color_of(bits >> 10, bits >> 5, bits);
}

// Vertices that are told apart by their bits; 0 and −0 are one.
class Welded {
 public:
  void add(const std::array<Point3f, 3>& corners) {
    std::array<std::uint32_t, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = index(corners[i]);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh_.triangles.push_back(t);
  }
  // Of the facet that was added last, where it became a triangle.
  void color(const FacetColor& color) {
    colors_.resize(3 * mesh_.triangles.size(), uncolored);
    if (!colors_.empty()) std::ranges::copy(color, colors_.end() - 3);
  }

  TriangleMesh take() {
    if (colors_.empty()) return std::move(mesh_);
    colors_.resize(3 * mesh_.triangles.size(), uncolored);
    mesh_.attributes.push_back({stl_color, true, 3, std::move(colors_)});
    return std::move(mesh_);
  }

 private:
  static constexpr float uncolored = 0.5f;

  struct Hash {
    std::size_t operator()(const Point3f& p) const {
      std::size_t h = 0;
      for (const float v : {p.x, p.y, p.z})
        h = (h ^ std::bit_cast<std::uint32_t>(v + 0.0f)) * std::size_t{0x9e3779b97f4a7c15u};
      return h ^ h >> 32;
    }
  };
  std::uint32_t index(Point3f p) {
    const auto [at, is_new] = indices_.try_emplace(p, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) mesh_.positions.push_back(p);
    return at->second;
  }

  TriangleMesh mesh_;
  std::vector<float> colors_;
  std::unordered_map<Point3f, std::uint32_t, Hash> indices_;
};

std::uint32_t facets_of(const InputBytes& bytes) {
  std::array<unsigned char, 4> b{};
  std::memcpy(b.data(), bytes.begin() + header - 4, 4);
  return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 |
         std::uint32_t{b[3]} << 24;
}

std::string_view text_of(const InputBytes& bytes) {
  const char* const begin = after_byte_order_mark(bytes.begin(), bytes.begin() + bytes.size());
  return {begin, bytes.begin() + bytes.size()};
}

bool is_word(std::string_view word, std::string_view wanted) {
  return std::ranges::equal(word, wanted, [](char a, char b) { return lower_case(a) == b; });
}

// Whether it begins as text does, with no byte of numbers in its first line.
bool begins_as_text(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos || !is_word(text.substr(begin, 5), "solid")) return false;
  const std::string_view line =
      text.substr(begin, std::min<std::size_t>(text.find('\n', begin), header) - begin);
  return line.find('\0') == std::string_view::npos;
}

// Bytes may follow the facets of a file that cannot be text.
bool is_binary(const InputBytes& bytes) {
  if (bytes.size() < header) return false;
  const std::size_t size = header + std::size_t{facets_of(bytes)} * facet;
  return bytes.size() == size || (bytes.size() > size && !begins_as_text(text_of(bytes)));
}

// The colour of facets without one of their own, which Materialise's programs put into the header; its
// alpha is not looked at.
std::optional<FacetColor> color_of_all(const InputBytes& bytes) {
  constexpr std::string_view key = "COLOR=";
  const std::string_view head(bytes.begin(), header - 4);
  const std::size_t at = head.find(key);
  if (at == std::string_view::npos || at + key.size() + 4 > head.size()) return {};
  FacetColor color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = static_cast<float>(srgb_decode(static_cast<unsigned char>(head[at + key.size() + c]) / 255.0));
  return color;
}

TriangleMesh read_binary(const InputBytes& bytes, const std::string& name) {
  Welded welded;
  const std::uint32_t count = facets_of(bytes);
  const std::optional<FacetColor> of_all = color_of_all(bytes);
  for (std::size_t i = 0; i < count; ++i) {
    const char* const at = bytes.begin() + header + i * facet;
    std::array<float, 9> v{};
    std::memcpy(v.data(), at + normal, sizeof v);
    for (const float x : v)
      if (!std::isfinite(x)) throw Error(fmt::format("facet {} has a corner that is not finite", i), {name});
    welded.add({Point3f{v[0], v[1], v[2]}, Point3f{v[3], v[4], v[5]}, Point3f{v[6], v[7], v[8]}});
    const unsigned bits = static_cast<unsigned char>(at[corners_end]) |
                          static_cast<unsigned>(static_cast<unsigned char>(at[corners_end + 1])) << 8;
    // With a colour of all, the bit says that it counts, and red and blue have changed places.
    if (of_all)
      welded.color(bits & 0x8000 ? *of_all : color_of(bits, bits >> 5, bits >> 10));
    else if (const auto color = color_of_viscam(bits))
      welded.color(*color);
  }
  return welded.take();
}

float coordinate(TextCursor& text, const char* what) {
  const char* const begin = text.at();
  const auto value = static_cast<float>(text.number(what));
  if (!std::isfinite(value)) text.fail(fmt::format("{} is not finite", what), begin);
  return value;
}

// Passes a name, which may be of many words, up to the end of the line or to a facet that begins there.
void skip_name(TextCursor& text) {
  while (!text.at_line_end()) {
    TextCursor ahead = text;
    if (is_word(ahead.word(), "facet") && !ahead.at_line_end() && is_word(ahead.word(), "normal")) return;
    text.word();
  }
}

// Passes the normal, which may be nan: corners say as much.
void skip_normal(TextCursor& text) {
  for (int i = 0; i < 4 && !text.at_line_end(); ++i) {
    TextCursor ahead = text;
    const std::string_view word = ahead.word();
    if (is_word(word, "outer") || is_word(word, "loop") || is_word(word, "vertex")) return;
    text = ahead;
  }
}

TriangleMesh read_text(std::string_view bytes, const std::string& name) {
  TextCursor text(name, bytes.begin(), bytes.end());
  if (!text.skip_to_text() || !is_word(text.word(), "solid"))
    throw Error("this is no STL: it neither begins with \"solid\" nor has the size that it states",
                {name, 1});
  skip_name(text);
  Welded welded;
  std::array<Point3f, 3> corners{};
  std::size_t corner = 0;
  while (text.skip_to_text()) {
    const char* const begin = text.at();
    const std::string_view word = text.word();
    if (is_word(word, "vertex")) {
      if (corner == 3) text.fail("a facet of more than three corners", begin);
      Point3f& p = corners[corner++];
      p.x = coordinate(text, "x"), p.y = coordinate(text, "y"), p.z = coordinate(text, "z");
    } else if (is_word(word, "endfacet")) {
      if (corner != 3) text.fail("a facet of fewer than three corners", begin);
      welded.add(corners);
      corner = 0;
    } else if (is_word(word, "color")) {
      welded.color(*color_of_viscam(static_cast<unsigned>(text.number("color")) | 0x8000));
    } else if (is_word(word, "facet")) {
      skip_normal(text);
    } else if (is_word(word, "solid") || is_word(word, "endsolid")) {
      skip_name(text);
    } else if (!is_word(word, "outer") && !is_word(word, "loop") && !is_word(word, "endloop")) {
      text.fail(fmt::format("\"{}\" is no word of STL", printable(word)), begin);
    }
  }
  if (corner != 0) text.fail("the file ends within a facet");
  return welded.take();
}

}  // namespace

TriangleMesh read_stl(const std::filesystem::path& file) {
  const InputBytes bytes(file);
  TriangleMesh mesh =
      is_binary(bytes) ? read_binary(bytes, file.string()) : read_text(text_of(bytes), file.string());
  if (mesh.triangles.empty()) throw Error("it has no facets that enclose an area", {file.string()});
  return mesh;
}

}  // namespace vitrail
