// SPDX-License-Identifier: Apache-2.0
#include "partitioner/write_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "partitioner/build_bvh.h"
#include "partitioner/write_objects.h"

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

// Whose ids are indices into `triangles` for now.
std::vector<TriangleReference> references_of(const NumberedTriangles& triangles, const CellContent& cell) {
  std::vector<TriangleReference> references;
  references.reserve(cell.size());
  for (const std::uint32_t i : cell.whole) {
    TriangleReference& r = references.emplace_back(TriangleReference{{}, triangles.triangles[i], i});
    for (const Point3f& v : r.vertices) extend(r.bounds, v);
  }
  for (const Piece& p : cell.pieces)
    references.push_back({bounds_of(cell.polygon(p)), triangles.triangles[p.triangle], p.triangle});
  return references;
}

// Of the boxes of the root's children, which are padded already.
void extend_by_root(Bounds3f& b, std::span<const BvhNode> nodes) {
  if (nodes.empty()) return;
  const BvhNode& root = nodes[0];
  for (std::size_t i = 0; i < 8; ++i) {
    if (root.child[i] == BvhNode::empty) continue;
    extend(b, Bounds3f{{root.lower[0][i], root.lower[1][i], root.lower[2][i]},
                       {root.upper[0][i], root.upper[1][i], root.upper[2][i]}});
  }
}

Occupancy occupancy_of(const Bounds3f& box, const NumberedTriangles& triangles, const CellContent& cell,
                       std::span<const InstanceRef> instances, float padding) {
  Occupancy occupancy;
  for (const std::uint32_t i : cell.whole) {
    const Triangle& t = triangles.triangles[i];
    mark(occupancy, box, std::array{cast<double>(t[0]), cast<double>(t[1]), cast<double>(t[2])}, padding);
  }
  for (const Piece& p : cell.pieces) mark(occupancy, box, cell.polygon(p), padding);
  for (const InstanceRef& ref : instances) mark(occupancy, box, box_of(ref));
  return occupancy;
}

}  // namespace

DomainContent make_domain(const NumberedTriangles& triangles, const CellContent& cell, float padding) {
  ClusteredTriangles built = build_bvh(references_of(triangles, cell), padding);
  DomainContent content;
  content.nodes = std::move(built.nodes);
  content.clusters = std::move(built.clusters);
  content.pieces = cell.pieces;
  content.piece_vertices = cell.piece_vertices;
  for (Piece& p : content.pieces) p.triangle = triangles.ids[p.triangle];
  const std::size_t slots = triangles.attributes.size();
  if (!triangles.normals.empty()) content.normals.resize(content.clusters.size());
  if (!triangles.uvs.empty()) content.uvs.resize(content.clusters.size());
  content.attributes.resize(content.clusters.size() * slots);
  for (std::size_t c = 0; c < content.clusters.size(); ++c)
    for (std::size_t lane = 0; lane < cluster_width; ++lane) {
      std::uint32_t& id = content.clusters[c].id[lane];
      const std::uint32_t i = id;
      if (i != no_triangle) id = triangles.ids[i];
      for (std::size_t k = 0; k < 3; ++k) {
        if (!content.normals.empty())
          content.normals[c].normal[lane][k] = i == no_triangle ? no_normal : triangles.normals[i][k];
        if (i == no_triangle) continue;
        if (!content.uvs.empty()) {
          content.uvs[c].uv[lane][k][0] = triangles.uvs[i][k].x;
          content.uvs[c].uv[lane][k][1] = triangles.uvs[i][k].y;
        }
        for (std::size_t s = 0; s < slots; ++s)
          std::ranges::copy(triangles.attributes[s][i][k], content.attributes[c * slots + s].value[lane][k]);
      }
    }
  return content;
}

void add_instances(std::vector<InstanceRef> instances, float padding, DomainContent& content) {
  std::vector<Bounds3f> boxes;
  for (InstanceRef& ref : instances) {
    boxes.push_back(box_of(ref));
    set_box(ref, inflated(boxes.back(), padding));
  }
  content.instances = std::move(instances);
  content.instance_nodes = build_tree(boxes, padding);
}

StoreDomain domain_files(std::filesystem::path bundle) {
  return [bundle = std::move(bundle)](std::uint32_t domain, const DomainContent& content, DomainInfo& info) {
    info.bytes = write_domain_file(domain_path(bundle, domain), content, &info.hash);
  };
}

DomainInfo write_domain(const Manifest& manifest, const NumberedTriangles& triangles, const CellContent& cell,
                        std::vector<InstanceRef> instances, const StoreDomain& store, std::uint32_t index,
                        Census& census) {
  const auto pad = static_cast<float>(padding(manifest));
  DomainContent content = make_domain(triangles, cell, pad);
  add_instances(std::move(instances), pad, content);
  census.add(index, view_of(content), content.pieces, content.piece_vertices);
  DomainInfo info{.triangles = cell.size(), .pieces = cell.pieces.size()};
  extend_by_root(info.tight_bounds, content.nodes);
  extend_by_root(info.tight_bounds, content.instance_nodes);
  info.occupancy = occupancy_of(info.tight_bounds, triangles, cell, content.instances, pad);
  info.instances = content.instances.size();
  info.objects = needed_objects(manifest, content.instances);
  store(index, std::move(content), info);
  return info;
}

}  // namespace vitrail
