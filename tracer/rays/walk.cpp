// SPDX-License-Identifier: Apache-2.0
#include "tracer/rays/walk.h"

#include <bit>
#include <limits>

namespace vitrail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Axes = std::array<double, 3>;

double greatest(const Axes& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

// Slab test in double; conservative for boxes that are padded, by `margin` more. Returns the entry, or +∞
// when missed within [0, tmax].
double enter_box(const Bounds3f& box, double margin, const Axes& origin, const Axes& reciprocal,
                 double tmax) {
  double t0 = 0, t1 = tmax;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    const double a = (static_cast<double>(box.lower[i]) - margin - origin[axis]) * reciprocal[axis];
    const double b = (static_cast<double>(box.upper[i]) + margin - origin[axis]) * reciprocal[axis];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return t0 <= t1 * (1 + 1e-12) ? t0 : infinity;
}

}  // namespace

bool DomainWalk::is_sampled(const Ray& ray) {
  const auto bits = [](float a, float b) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b);
  };
  // Multiplicative hashing (Knuth, TAOCP 6.4): the upper bits of the product.
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;
  std::uint64_t hash = bits(ray.origin.x, ray.origin.y) * golden;
  hash = (hash >> 32 ^ hash ^ bits(ray.origin.z, ray.direction.x)) * golden;
  hash = (hash >> 32 ^ hash ^ bits(ray.direction.y, ray.direction.z)) * golden;
  return (hash >> 32) % sampled_one_in == 0;
}

void DomainWalk::begin(const Ray& ray) {
  const Point3d o = cast<double>(ray.origin);
  const Vector3d d = cast<double>(ray.direction);
  origin_ = {o.x, o.y, o.z};
  direction_ = {d.x, d.y, d.z};
  rounding_ = 0x1p-47 * greatest(origin_);
  epsilon_ = interface_epsilon(manifest_) + rounding_;
  // A component too small to divide by moves the ray by 10⁻¹⁸ of its way.
  const double least = 1e-18 * greatest(direction_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double along = direction_[axis];
    reciprocal_[axis] = 1 / (std::abs(along) < least ? (along < 0 ? -least : least) : along);
  }
  stack_[static_cast<std::size_t>(size_++)] = {manifest_.kd_nodes.empty() ? KdNode::leaf_bit : 0u, false, 0,
                                               infinity};
}

void DomainWalk::enter_shared(const KdNode& node) {
  shared_.first = node.below & ~KdNode::leaf_bit;
  shared_.left = static_cast<std::uint32_t>(node.split);
  shared_.below = size_;
  shared_.met = 0;
  shared_.more.assign(shared_.left > 64 ? shared_.left - 64 : 0, false);
}

// Whether a leaf of a shared cell has not been met before. Behind the last of them the walk leaves the cell.
bool DomainWalk::is_first(std::uint32_t reference) {
  const std::uint32_t i = (reference & ~KdNode::leaf_bit) - shared_.first;
  if (i < 64 ? (shared_.met >> i & 1) != 0 : shared_.more[i - 64]) return false;
  if (i < 64)
    shared_.met |= std::uint64_t{1} << i;
  else
    shared_.more[i - 64] = true;
  if (--shared_.left == 0) size_ = shared_.below;
  return true;
}

// The near side reaches until ε behind the plane, the far side begins ε before it.
DomainWalk::Sides DomainWalk::sides_of(const KdNode& node, const Pending& at) const {
  const std::size_t axis = node.axis;
  const double to_plane = static_cast<double>(node.split) - origin_[axis];
  const double reciprocal = reciprocal_[axis];
  const bool ascending = reciprocal > 0;
  const double along = ascending ? to_plane : -to_plane, rate = std::abs(reciprocal);
  Sides s{ascending ? node.below : node.above, ascending ? node.above : node.below, (along + epsilon_) * rate,
          (along - epsilon_) * rate};
  s.in_near = s.near_end >= at.t0, s.in_far = s.far_begin <= at.t1;
  return s;
}

// The next one that the ray enters at tmax or before.
bool DomainWalk::next_leaf(double tmax, Pending& leaf) {
  while (size_ > 0) {
    Pending at = stack_[static_cast<std::size_t>(--size_)];
    at.t1 = std::min(at.t1, tmax);
    while (at.t0 <= tmax && !(at.reference & KdNode::leaf_bit)) {
      const KdNode& node = manifest_.kd_nodes[at.reference];
      if (node.axis == KdNode::no_axis) {
        if (!at.shared) enter_shared(node);
        stack_[static_cast<std::size_t>(size_++)] = {node.above, true, at.t0, at.t1};
        at.reference = node.below, at.shared = true;
        continue;
      }
      const Sides s = sides_of(node, at);
      const Pending far{s.far, at.shared, std::max(at.t0, s.far_begin), at.t1};
      if (s.in_near && s.in_far) stack_[static_cast<std::size_t>(size_++)] = far;
      at = s.in_near ? Pending{s.near, at.shared, at.t0, std::min(at.t1, s.near_end)} : far;
    }
    if (at.t0 > tmax || (at.shared && !is_first(at.reference))) continue;
    leaf = at;
    return true;
  }
  return false;
}

bool DomainWalk::next_of_many(double tmax, Visit& visit) {
  Pending leaf;
  while (next_leaf(tmax, leaf)) {
    const std::uint32_t domain = leaf.reference & ~KdNode::leaf_bit;
    const DomainInfo& info = manifest_.domains[domain];
    if (info.tight_bounds.empty()) continue;
    const double entry = enter_box(info.tight_bounds, rounding_, origin_, reciprocal_, tmax);
    if (entry == infinity) continue;
    visit = {domain, std::max(leaf.t0, entry)};
    // From far away the way through the cells is less certain than they are padded.
    if (rounding_ < cell_margin(manifest_) &&
        !meets(info.occupancy, info.tight_bounds, {origin_[0], origin_[1], origin_[2]},
               {direction_[0], direction_[1], direction_[2]}, visit.entry, tmax))
      continue;
    return true;
  }
  return false;
}

void DomainWalk::skip_leaves(std::uint32_t domain) {
  Pending leaf;
  while (next_leaf(infinity, leaf))
    if ((leaf.reference & ~KdNode::leaf_bit) == domain) return;
}

// `at`: of the root, and then of the domain's cell; what comes behind it is on the stack. False where the ray
// does not come there.
bool DomainWalk::descend(std::uint32_t domain, const CellWays& ways, Pending& at) {
  std::array<std::uint32_t, 64> way;  // from the cell to below the root
  std::size_t count = 0;
  way[count++] = ways.cell_of(domain);
  for (std::uint32_t node = ways.above_cell(domain); node != CellWays::none; node = ways.above(node)) {
    if (count == way.size()) return false;
    way[count++] = node;
  }
  for (std::size_t i = count - 1; i-- > 0;) {
    const Sides s = sides_of(manifest_.kd_nodes[at.reference], at);
    const Pending far{s.far, false, std::max(at.t0, s.far_begin), at.t1};
    if (way[i] == s.far) {
      if (s.in_near && !s.in_far) return false;
      at = far;
      continue;
    }
    if (!s.in_near) return false;
    if (s.in_far) stack_[static_cast<std::size_t>(size_++)] = far;
    at = {s.near, false, at.t0, std::min(at.t1, s.near_end)};
  }
  return true;
}

void DomainWalk::skip_past(std::uint32_t domain, const CellWays& ways) {
  only_one_ = false;
  if (size_ == 0) return;
  const Pending root = stack_[0];
  size_ = 0;
  Pending at = root;
  const bool comes_there = descend(domain, ways, at);
  if (comes_there && (at.reference & KdNode::leaf_bit)) return;
  if (!comes_there) size_ = 0;
  stack_[static_cast<std::size_t>(size_++)] = comes_there ? at : root;
  skip_leaves(domain);
}

}  // namespace vitrail
