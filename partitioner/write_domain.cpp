// SPDX-License-Identifier: Apache-2.0
#include "partitioner/write_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "partitioner/build_bvh.h"

namespace vitrail {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

float rounded_down(double x) {
  const auto f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -infinity) : f;
}
float rounded_up(double x) { return -rounded_down(-x); }

Bounds3f bounds_of(std::span<const Point3d> polygon) {
  Bounds3d b;
  for (const Point3d& p : polygon) extend(b, p);
  return {{rounded_down(b.lower.x), rounded_down(b.lower.y), rounded_down(b.lower.z)},
          {rounded_up(b.upper.x), rounded_up(b.upper.y), rounded_up(b.upper.z)}};
}

std::vector<TriangleReference> references_of(const FlatScene& scene, const CellContent& cell) {
  std::vector<TriangleReference> references;
  references.reserve(cell.size());
  for (const std::uint32_t id : cell.whole) {
    TriangleReference& r = references.emplace_back(TriangleReference{{}, scene.triangles[id], id});
    for (const Point3f& v : r.vertices) extend(r.bounds, v);
  }
  for (const Piece& p : cell.pieces)
    references.push_back({bounds_of(cell.polygon(p)), scene.triangles[p.triangle], p.triangle});
  return references;
}

// Of the boxes of the root's children, which are padded already.
Bounds3f tight_bounds(const DomainContent& content) {
  Bounds3f b;
  if (content.nodes.empty()) return b;
  const BvhNode& root = content.nodes[0];
  for (std::size_t i = 0; i < 8; ++i) {
    if (root.child[i] == BvhNode::empty) continue;
    extend(b, Bounds3f{{root.lower[0][i], root.lower[1][i], root.lower[2][i]},
                       {root.upper[0][i], root.upper[1][i], root.upper[2][i]}});
  }
  return b;
}

}  // namespace

DomainContent make_domain(const FlatScene& scene, const CellContent& cell) {
  ClusteredTriangles built =
      build_bvh(references_of(scene, cell), static_cast<float>(padding(scene.manifest)));
  DomainContent content{std::move(built.nodes), std::move(built.clusters), {}, {}, {}, cell.pieces,
                        cell.piece_vertices};
  const std::size_t slots = scene.attributes.size();
  if (!scene.normals.empty()) content.normals.resize(content.clusters.size());
  if (!scene.uvs.empty()) content.uvs.resize(content.clusters.size());
  content.attributes.resize(content.clusters.size() * slots);
  for (std::size_t c = 0; c < content.clusters.size(); ++c)
    for (std::size_t lane = 0; lane < cluster_width; ++lane) {
      const std::uint32_t id = content.clusters[c].id[lane];
      for (std::size_t k = 0; k < 3; ++k) {
        if (!content.normals.empty())
          content.normals[c].normal[lane][k] = id == no_triangle ? no_normal : scene.normals[id][k];
        if (id == no_triangle) continue;
        if (!content.uvs.empty()) {
          content.uvs[c].uv[lane][k][0] = scene.uvs[id][k].x;
          content.uvs[c].uv[lane][k][1] = scene.uvs[id][k].y;
        }
        for (std::size_t s = 0; s < slots; ++s)
          std::ranges::copy(scene.attributes[s][id][k], content.attributes[c * slots + s].value[lane][k]);
      }
    }
  return content;
}

DomainInfo write_domain(const FlatScene& scene, const CellContent& cell, const std::filesystem::path& bundle,
                        std::uint32_t index, Census& census) {
  const DomainContent content = make_domain(scene, cell);
  census.add(index, view_of(content), content.pieces, content.piece_vertices);
  const std::filesystem::path file = domain_path(bundle, index);
  DomainInfo info{cell.size(), cell.pieces.size(), write_domain_file(file, content), 0,
                  tight_bounds(content)};
  info.hash = MappedDomain(file).hash();
  return info;
}

}  // namespace vitrail
