// SPDX-License-Identifier: Apache-2.0
#include "partitioner/writing/write_domain.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "partitioner/hierarchy/build_bvh.h"
#include "partitioner/writing/curve_boxes.h"
#include "partitioner/writing/write_objects.h"
#include "scene/system/huge_pages.h"

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

Bounds3f bounds_of(const Triangle& t) {
  Bounds3f b;
  for (const Point3f& v : t) extend(b, v);
  return b;
}

// The whole triangles', then the pieces'.
std::vector<Bounds3f> boxes_of(const NumberedTriangles& triangles, const CellContent& cell, bool padded) {
  std::vector<Bounds3f> boxes;
  reserve_huge(boxes, cell.size());
  const auto add = [&](const Bounds3f& box, const Bounds3f& uncut) {
    boxes.push_back(padded ? inflated(box, padding(greatest(uncut))) : box);
  };
  for (const std::uint32_t i : cell.whole) {
    const Bounds3f box = bounds_of(triangles.triangles[i]);
    add(box, box);
  }
  for (const Piece& p : cell.pieces)
    add(bounds_of(cell.polygon(p)), bounds_of(triangles.triangles[p.triangle]));
  return boxes;
}

// The boxes of the leaves become the triangles that they are of. Returns the pieces among them, in this
// order.
std::vector<Piece> name_triangles(const CellContent& cell, std::span<std::uint32_t> leaves) {
  std::vector<Piece> pieces;
  pieces.reserve(cell.pieces.size());
  for (std::uint32_t& i : leaves) {
    if (i == no_triangle) continue;
    if (i >= cell.whole.size()) pieces.push_back(cell.pieces[i - cell.whole.size()]);
    i = i < cell.whole.size() ? cell.whole[i] : pieces.back().triangle;
  }
  return pieces;
}

constexpr Triangle empty_lane = [] {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  return Triangle{Point3f{nan, nan, nan}, Point3f{nan, nan, nan}, Point3f{nan, nan, nan}};
}();

void fill_cluster(const NumberedTriangles& triangles, std::span<const std::uint32_t> lanes, Cluster& out) {
  for (std::size_t lane = 0; lane < cluster_width; ++lane) {
    const std::uint32_t i = lanes[lane];
    const Triangle& t = i == no_triangle ? empty_lane : triangles.triangles[i];
    out.id[lane] = i == no_triangle ? no_triangle : triangles.ids[i];
    for (std::size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis) out.vertex[k][axis][lane] = t[k][axis];
  }
}

}  // namespace

DomainContent make_domain(const NumberedTriangles& triangles, const CellContent& cell, bool padded) {
  BoxTree tree = build_bvh(boxes_of(triangles, cell, padded), cluster_width);
  DomainContent content;
  content.pieces = name_triangles(cell, tree.leaves);
  content.nodes = std::move(tree.nodes);
  content.piece_vertices = cell.piece_vertices;
  for (Piece& p : content.pieces) p.triangle = triangles.ids[p.triangle];
  const std::size_t clusters = tree.leaves.size() / cluster_width, slots = triangles.attributes.size();
  reserve_huge(content.clusters, clusters);
  if (!triangles.normals.empty()) content.normals.resize(clusters);
  if (!triangles.uvs.empty()) content.uvs.resize(clusters);
  content.attributes.resize(clusters * slots);
  for (std::size_t c = 0; c < clusters; ++c) {
    const auto lanes = std::span(tree.leaves).subspan(c * cluster_width, cluster_width);
    fill_cluster(triangles, lanes, content.clusters.emplace_back());
    for (std::size_t lane = 0; lane < cluster_width; ++lane) {
      const std::uint32_t i = lanes[lane];
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
  }
  return content;
}

void add_instances(std::vector<InstanceRef> instances, std::span<const ObjectInfo> objects,
                   DomainContent& content) {
  std::vector<Bounds3f> boxes;
  std::vector<std::uint32_t> instance_of;  // of each box
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    InstanceRef& ref = instances[i];
    const auto& quadric = objects[ref.object].quadric;
    if (quadric && is_curve(quadric->quadric))
      std::ranges::copy(curve_boxes(ref), std::back_inserter(boxes));
    else
      boxes.push_back(box_of(ref));
    instance_of.resize(boxes.size(), i);
    set_box(ref, inflated(box_of(ref), 0));
  }
  content.instances = std::move(instances);
  content.instance_nodes = build_tree(boxes);
  for (BvhNode& node : content.instance_nodes)
    for (std::uint32_t& child : node.child)
      if (child != BvhNode::empty && child & BvhNode::cluster_bit)
        child = BvhNode::cluster_bit | instance_of[child & ~BvhNode::cluster_bit];
}

StoreDomain domain_files(std::filesystem::path bundle) {
  return [bundle = std::move(bundle)](std::uint32_t domain, const DomainContent& content, DomainInfo& info) {
    info.bytes = write_domain_file(domain_path(bundle, domain), content, &info.hash);
  };
}

DomainInfo write_domain(const Manifest& manifest, const NumberedTriangles& triangles, const CellContent& cell,
                        std::vector<InstanceRef> instances, const StoreDomain& store, std::uint32_t index,
                        Census& census) {
  DomainContent content = make_domain(triangles, cell, true);
  add_instances(std::move(instances), manifest.objects, content);
  census.add(index, view_of(content), content.pieces, content.piece_vertices);
  DomainInfo info{.triangles = cell.size(), .pieces = cell.pieces.size()};
  info.tight_bounds = content_bounds(view_of(content));
  info.occupancy = occupancy_of(info.tight_bounds, view_of(content), content.pieces, content.piece_vertices,
                                cell_margin(manifest));
  info.instances = content.instances.size();
  info.objects = needed_objects(manifest, content.instances);
  store(index, std::move(content), info);
  return info;
}

}  // namespace vitrail
