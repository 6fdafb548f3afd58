// SPDX-License-Identifier: Apache-2.0
// SAH clusters and the 8-wide BVH over them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bundle/domain_file.h"

namespace vitrail {

// A triangle, or its part in one domain. `bounds` may be smaller than the triangle's where it is cut.
struct TriangleReference {
  Bounds3f bounds;                  // of the part in this domain, rounded outwards
  std::array<Point3f, 3> vertices;  // of the uncut triangle
  std::uint32_t id = 0;             // global triangle id
};

// Invariants: node 0 is the root; a node comes before its children, which keep their order; so do clusters.
// Within a cluster the lanes are in the order of the references.
struct ClusteredTriangles {
  std::vector<BvhNode> nodes;
  std::vector<Cluster> clusters;
  std::vector<std::uint32_t> lane_reference;  // [cluster·8 + lane]: index into `references`, or no_triangle
};

// Clusters by Embree's SAH builder (rtcBuildBVH), at most 8 triangles each, and its binary tree collapsed to
// 8-wide nodes of least SAH cost. A box holds the bounds of its references, inflated on every side by padding
// + 10⁻⁶|x|. The result does not depend on the number of threads. Triangles of zero area are kept; no
// references give no nodes. Throws MachineError when Embree fails.
ClusteredTriangles build_bvh(std::span<const TriangleReference> references, float padding);

// A box moved by padding + 10⁻⁶|x| on every side.
Bounds3f inflated(const Bounds3f& box, float padding);

// The same tree with a leaf for each of the boxes, BvhNode::cluster_bit | its position.
std::vector<BvhNode> build_tree(std::span<const Bounds3f> boxes, float padding);

}  // namespace vitrail
