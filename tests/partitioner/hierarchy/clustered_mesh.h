// SPDX-License-Identifier: Apache-2.0
// Triangles as a domain in memory, for tests of the intersection.
#pragma once

#include <array>
#include <vector>

#include "partitioner/hierarchy/build_bvh.h"
#include "tracer/intersect/exact_test.h"
#include "tracer/intersect/intersector.h"

namespace vitrail::test {

using Triangle = std::array<Point3f, 3>;
using Triangles = std::vector<Triangle>;

inline float greatest_coordinate(const Triangles& triangles) {
  float greatest = 0;
  for (const Triangle& triangle : triangles) {
    for (const Point3f p : triangle)
      greatest = std::max({greatest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return greatest;
}

struct ClusteredTriangles {
  std::vector<BvhNode> nodes;
  std::vector<Cluster> clusters;
  std::vector<std::uint32_t> lane_reference;  // [cluster·8 + lane]: position in the list, or no_triangle
};

// Ids are the positions in the list.
inline ClusteredTriangles cluster(const Triangles& triangles, bool padded = true) {
  std::vector<Bounds3f> boxes(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const Point3f p : triangles[i]) extend(boxes[i], p);
    if (padded) boxes[i] = inflated(boxes[i], padding(greatest(boxes[i])));
  }
  BoxTree tree = build_bvh(boxes, cluster_width);
  ClusteredTriangles out{std::move(tree.nodes), {}, std::move(tree.leaves)};
  out.clusters.resize(out.lane_reference.size() / cluster_width);
  for (std::size_t i = 0; i < out.lane_reference.size(); ++i) {
    const std::uint32_t triangle = out.lane_reference[i];
    Cluster& c = out.clusters[i / cluster_width];
    c.id[i % cluster_width] = triangle;
    for (std::size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        c.vertex[k][axis][i % cluster_width] =
            triangle == no_triangle ? std::numeric_limits<float>::quiet_NaN() : triangles[triangle][k][axis];
  }
  return out;
}

inline DomainView view_of(const ClusteredTriangles& clustered) {
  DomainView view{clustered.nodes, clustered.clusters, {}};
  view.reach = reach_of(view);
  return view;
}

// Every triangle of every cluster, by the exact test alone.
inline Hit brute_force(const DomainView& domain, const Ray& ray) {
  const RayConstants constants = prepare(ray);
  Hit hit;
  for (std::uint32_t c = 0; c < domain.clusters.size(); ++c) {
    for (std::uint32_t lane = 0; lane < cluster_width; ++lane) {
      const std::uint32_t id = domain.clusters[c].id[lane];
      ExactHit exact;
      if (id == no_triangle || id == ray.exclude || !seen_hit(constants, domain.clusters[c], lane, exact))
        continue;
      if (exact.t < hit.t || (exact.t == hit.t && id < hit.triangle))
        hit = {exact.t, id, c, lane, 0, exact.u, exact.v};
    }
  }
  return hit;
}

// The same triangle at the same point, to the last bit, wherever it is stored.
inline bool same(const Hit& a, const Hit& b) {
  return a.t == b.t && a.triangle == b.triangle && a.u == b.u && a.v == b.v;
}

}  // namespace vitrail::test
