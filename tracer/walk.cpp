// SPDX-License-Identifier: Apache-2.0
#include "tracer/walk.h"

#include <limits>

namespace vitrail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double greatest(Vector3d v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

double enter_box(const Bounds3f& box, double margin, Point3d origin, Vector3d reciprocal, double tmax) {
  double t0 = 0, t1 = tmax;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (static_cast<double>(box.lower[axis]) - margin - origin[axis]) * reciprocal[axis];
    const double b = (static_cast<double>(box.upper[axis]) + margin - origin[axis]) * reciprocal[axis];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return t0 <= t1 * (1 + 1e-12) ? t0 : infinity;
}

void DomainWalk::begin(const Ray& ray) {
  origin_ = cast<double>(ray.origin);
  direction_ = cast<double>(ray.direction);
  rounding_ = 0x1p-47 * greatest(origin_ - Point3d{});
  epsilon_ = interface_epsilon(manifest_) + rounding_;
  // A component too small to divide by moves the ray by 10⁻¹⁸ of its way.
  const double least = 1e-18 * greatest(direction_);
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction_[axis];
    reciprocal_[axis] = 1 / (std::abs(d) < least ? (d < 0 ? -least : least) : d);
  }
  stack_[static_cast<std::size_t>(size_++)] = {manifest_.kd_nodes.empty() ? KdNode::leaf_bit : 0u, 0,
                                               infinity};
}

bool DomainWalk::next_leaf(Pending& leaf) {
  while (size_ > 0) {
    Pending at = stack_[static_cast<std::size_t>(--size_)];
    while (!(at.reference & KdNode::leaf_bit)) {
      const KdNode& node = manifest_.kd_nodes[at.reference];
      const int axis = static_cast<int>(node.axis);
      const double to_plane = static_cast<double>(node.split) - origin_[axis];
      const double reciprocal = reciprocal_[axis];
      const bool ascending = reciprocal > 0;
      const std::uint32_t near = ascending ? node.below : node.above,
                          far = ascending ? node.above : node.below;
      // The near side reaches until ε behind the plane, the far side begins ε before it.
      const double along = ascending ? to_plane : -to_plane, rate = std::abs(reciprocal);
      const double near_end = (along + epsilon_) * rate, far_begin = (along - epsilon_) * rate;
      const bool in_near = near_end >= at.t0, in_far = far_begin <= at.t1;
      if (in_near && in_far)
        stack_[static_cast<std::size_t>(size_++)] = {far, std::max(at.t0, far_begin), at.t1};
      if (in_near)
        at = {near, at.t0, std::min(at.t1, near_end)};
      else
        at = {far, std::max(at.t0, far_begin), at.t1};
    }
    leaf = at;
    return true;
  }
  return false;
}

bool DomainWalk::next_of_many(double tmax, Visit& visit) {
  Pending leaf;
  while (next_leaf(leaf)) {
    if (leaf.t0 > tmax) continue;
    const std::uint32_t domain = leaf.reference & ~KdNode::leaf_bit;
    const DomainInfo& info = manifest_.domains[domain];
    if (info.tight_bounds.empty()) continue;
    const double entry = enter_box(info.tight_bounds, rounding_, origin_, reciprocal_, tmax);
    if (entry == infinity) continue;
    visit = {domain, std::max(leaf.t0, entry)};
    // From far away the way through the cells is less certain than they are padded.
    if (rounding_ < cell_margin(manifest_) &&
        !meets(info.occupancy, info.tight_bounds, origin_, direction_, visit.entry, tmax))
      continue;
    return true;
  }
  return false;
}

void DomainWalk::skip_past(std::uint32_t domain) {
  only_one_ = false;
  Pending leaf;
  while (next_leaf(leaf))
    if ((leaf.reference & ~KdNode::leaf_bit) == domain) return;
}

}  // namespace vitrail
