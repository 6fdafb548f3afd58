// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/read/ply_corner_uvs.h"

#include <algorithm>
#include <limits>

#include "importers/ply/read/ply_rows.h"

namespace vitrail::ply {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Makes vertices of pairs of a vertex of the file and a (u,v).
class VertexSplitter {
 public:
  explicit VertexSplitter(std::size_t vertices) : first_(vertices, none) {}

  std::uint32_t vertex(std::uint32_t of, Point2f uv) {
    std::uint32_t* link = &first_[of];
    for (; *link != none; link = &next_[*link])
      if (uvs_[*link] == uv) return *link;
    if (origins_.size() == none) throw Error("more vertices than 32 bits count; split the mesh");
    const auto made = static_cast<std::uint32_t>(origins_.size());
    *link = made;  // before next_ grows, which may hold it
    origins_.push_back(of);
    uvs_.push_back(uv);
    next_.push_back(none);
    return made;
  }

  void apply(TriangleMesh& mesh) {
    spread(mesh.positions, 1);
    if (!mesh.normals.empty()) spread(mesh.normals, 1);
    for (MeshAttribute& attribute : mesh.attributes)
      if (!attribute.per_face) spread(attribute.values, static_cast<std::size_t>(attribute.channels));
    mesh.uvs = std::move(uvs_);
  }

 private:
  template <class T>
  void spread(std::vector<T>& values, std::size_t width) const {
    std::vector<T> spread;
    spread.reserve(width * origins_.size());
    for (const std::uint32_t of : origins_)
      for (std::size_t k = 0; k < width; ++k) spread.push_back(values[width * of + k]);
    values = std::move(spread);
  }

  std::vector<std::uint32_t> first_, next_, origins_;
  std::vector<Point2f> uvs_;
};

float finite(double value, Body& body) {
  const auto rounded = static_cast<float>(value);
  if (std::isfinite(rounded)) return rounded;
  ++body.lost_numbers;
  return 0;
}

template <class Source>
void read(Source source, const Header& header, const BodyPlan& plan, std::size_t property, Body& body) {
  for (std::size_t e = 0; e < plan.faces->element; ++e) skip_element(source, header.elements[e]);
  const Element& element = header.elements[plan.faces->element];
  VertexSplitter splitter(body.mesh.positions.size());
  std::vector<double> corners, uvs;
  std::size_t triangle = 0;
  const auto end_row = [&](std::size_t i) {
    if (i + 1 < element.properties.size() || corners.size() < 3) return;
    for (const std::size_t end = triangle + corners.size() - 2; triangle < end; ++triangle)
      for (std::uint32_t& corner : body.mesh.triangles.at(triangle)) {
        const auto k = static_cast<std::size_t>(std::ranges::find(corners, corner) - corners.begin());
        const bool has_uv = uvs.size() == 2 * corners.size() && k < corners.size();
        const Point2f uv =
            has_uv ? Point2f{finite(uvs[2 * k], body), finite(uvs[2 * k + 1], body)} : Point2f{};
        corner = splitter.vertex(corner, uv);
      }
  };
  read_rows(
      source, element, [&](std::size_t i, double) { end_row(i); },
      [&](std::size_t i, const std::vector<double>& items) {
        if (i == plan.faces->corner_list) corners = items;
        if (i == property) uvs = items;
        end_row(i);
      });
  splitter.apply(body.mesh);
}

}  // namespace

std::optional<std::size_t> corner_uvs_of(const Header& header, const BodyPlan& plan) {
  if (!plan.faces || plan.strips || plan.vertex.has_uvs()) return {};
  const auto& properties = header.elements[plan.faces->element].properties;
  const auto found = std::ranges::find(properties, "texcoord", &Property::name);
  if (found == properties.end() || !found->count_type) return {};
  return static_cast<std::size_t>(found - properties.begin());
}

void read_corner_uvs(const InputBytes& bytes, const TextCursor& cursor, const Header& header,
                     const BodyPlan& plan, std::size_t property, Body& body) {
  switch (header.format) {
    case Format::ascii:
      return read(AsciiSource(bytes, cursor), header, plan, property, body);
    case Format::binary_big_endian:
      return read(BinarySource<true>(bytes, cursor), header, plan, property, body);
    default:
      return read(BinarySource<false>(bytes, cursor), header, plan, property, body);
  }
}

}  // namespace vitrail::ply
