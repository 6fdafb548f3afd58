// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "scene/geometry/portable_math.h"
#include "tracer/lights/light_tree.h"
#include "tracer/lights/normal_cone.h"

namespace vitrail {

namespace {

// Bounds of a set of lights. Two-sided normals are turned to one half space to be bounded.
struct LightCluster {
  Bounds3d box;
  NormalCone cone;
  double theta_e_rad = 0, power = 0, least_power = 0;
  bool two_sided = false;
  // Σ power/near² where all have a distance up to which they do not weaken: what they send to a point amid
  // them. ∞: not all have.
  double amid = 0;
  bool empty = true;
};

LightCluster cluster_of(const LightBounds& l) {
  return {l.box,
          {l.axis, l.theta_o_rad},
          l.theta_e_rad,
          l.power,
          l.power,
          l.two_sided,
          l.near > 0 ? l.power / (l.near * l.near) : std::numeric_limits<double>::infinity(),
          false};
}

LightCluster united(const LightCluster& a, const LightCluster& b) {
  if (a.empty) return b;
  if (b.empty) return a;
  LightCluster c = a;
  extend(c.box, b.box);
  // A set with a two-sided light counts as two-sided: it may be asked more often than it has light, never
  // less.
  c.two_sided = a.two_sided || b.two_sided;
  NormalCone second = b.cone;
  if (c.two_sided && dot(a.cone.axis, second.axis) < 0) second.axis = -second.axis;
  c.cone = united(a.cone, second);
  c.theta_e_rad = std::max(a.theta_e_rad, b.theta_e_rad);
  c.power += b.power;
  c.least_power = std::min(a.least_power, b.least_power);
  c.amid += b.amid;
  return c;
}

// What splitting needs to know of a set of lights, cheaply: the mean of their normals instead of their cone.
struct Slab {
  Bounds3d box;
  Vector3d
      axis;  // Σ power · normal, in one half space for two-sided ones, shorter the wider the light's cone
  double power = 0;

  bool empty() const { return !(power > 0); }
  void add(const LightBounds& l, double cone) {
    extend(box, l.box);
    const bool turned = l.two_sided && dot(axis, l.axis) < 0;
    axis = axis + l.axis * (turned ? -l.power * cone : l.power * cone);
    power += l.power;
  }
  void add(const Slab& s) {
    extend(box, s.box);
    axis = axis + s.axis;
    power += s.power;
  }
};

// Power · area · solid angle, as in Conty Estevez & Kulla 2018, eq. 2. Their solid angle M_Ω goes from π of
// one direction to 4π of all; here by the mean resultant length of the normals, which goes from 1 to 0.
double cost(const Slab& s) {
  if (s.empty()) return 0;
  const Vector3d e = extent(s.box);
  return (surface_area(s.box) + 1e-3 * dot(e, e)) * (4 * s.power - 3 * length(s.axis));
}

// Lights whose θ_e is less emit nothing beyond θ_o, as far as a node tells.
constexpr double narrow_rad = 0.014;
// Of all power: lights with less are lost in a sum, so they are never chosen by one.
constexpr double least_share = 1e-12;

std::uint32_t pair(double lower, double upper) {
  return (static_cast<std::uint32_t>(static_cast<std::int32_t>(lower)) & 0xffffu) |
         static_cast<std::uint32_t>(static_cast<std::int32_t>(upper)) << 16;
}
// Of the least float of eight bits' precision that is not below x ≥ 0.
std::uint32_t upper_bits(double x) {
  return (std::bit_cast<std::uint32_t>(static_cast<float>(x)) + 0xffffu) >> 16;
}

constexpr int buckets = 12;
// From here on by number, which needs at most 11 more levels for 2³² lights.
constexpr int deepest_by_cost = 10;

}  // namespace

class LightTreeBuilder {
 public:
  LightTreeBuilder(LightTree& tree, std::size_t lights, const LightTree::BoundsOf& bounds)
      : tree_(tree), count_(lights), bounds_(bounds) {}

  void build() {
    order_.reserve(count_);
    cap_.reserve(count_);
    tree_.nodes_.reserve(count_ / 4 + 1);  // room that is not used takes no memory
    Bounds3d all;
    for (std::uint32_t i = 0; i < count_; ++i) {
      const LightBounds light = bounds_(i);
      cap_.push_back((1 + (light.theta_o_rad > 0 ? portable_cos(light.theta_o_rad) : 1)) / 2);
      if (!(light.power > 0 && std::isfinite(light.power))) continue;
      order_.push_back(i);
      extend(all, light.box);
      tree_.power_ += light.power;
    }
    tree_.slot_.assign(count_, LightTree::absent);
    if (order_.empty()) return;
    tree_.center_ = center(all);
    const Vector3d e = extent(all);
    const double half = std::max({e.x, e.y, e.z}) / 2;
    tree_.scale_ = half > 0 ? 1 / half : 1;
    tree_.nodes_.emplace_back();
    build_node(0, {0, order_.size()}, 0);
    list_slots();
  }

 private:
  struct Range {
    std::size_t begin = 0, end = 0;
    std::size_t size() const { return end - begin; }
  };

  Range split_off(Range& r, int depth) {
    std::size_t middle = depth < deepest_by_cost ? cheapest_split(r) : r.begin;
    if (middle == r.begin || middle == r.end) middle = middle_split(r);
    const Range above{middle, r.end};
    r.end = middle;
    return above;
  }

  double coordinate(std::uint32_t light, int axis) const { return center(bounds_(light).box)[axis]; }

  Bounds3d centers_of(Range r) const {
    Bounds3d b;
    for (std::size_t i = r.begin; i < r.end; ++i) extend(b, center(bounds_(order_[i]).box));
    return b;
  }

  std::size_t middle_split(Range r) {
    const Vector3d e = extent(centers_of(r));
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    std::sort(at(r.begin), at(r.end), [&](std::uint32_t a, std::uint32_t b) {
      const double x = coordinate(a, axis), y = coordinate(b, axis);
      return x != y ? x < y : a < b;
    });
    return r.begin + r.size() / 2;
  }

  // Of the planes between 12 slabs on each axis, that with the least Σ power · area · solid angle (ibid.,
  // eq. 2); r.begin where there is none.
  std::size_t cheapest_split(Range r) {
    const Bounds3d centers = centers_of(r);
    const Vector3d e = extent(centers);
    const double longest = std::max({e.x, e.y, e.z});
    double best = std::numeric_limits<double>::infinity();
    int best_axis = -1, best_plane = 0;
    const auto slab = [&](const LightBounds& light, int axis) {
      const double x = (center(light.box)[axis] - centers.lower[axis]) / e[axis] * buckets;
      return std::clamp(static_cast<int>(x), 0, buckets - 1);
    };
    std::array<std::array<Slab, buckets>, 3> slabs_of;
    for (std::size_t i = r.begin; i < r.end; ++i) {
      const LightBounds light = bounds_(order_[i]);
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (const int a = static_cast<int>(axis); e[a] > 1e-9 * longest)
          slabs_of[axis][static_cast<std::size_t>(slab(light, a))].add(light, cap_[order_[i]]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (!(e[axis] > 1e-9 * longest)) continue;
      const std::array<Slab, buckets>& slabs = slabs_of[static_cast<std::size_t>(axis)];
      std::array<Slab, buckets> above = slabs;
      for (std::size_t i = buckets - 1; i-- > 0;) above[i].add(above[i + 1]);
      Slab below;
      for (int plane = 1; plane < buckets; ++plane) {
        const auto i = static_cast<std::size_t>(plane);
        below.add(slabs[i - 1]);
        if (below.empty() || above[i].empty()) continue;
        const double c = (cost(below) + cost(above[i])) * (longest / e[axis]);
        if (c < best) best = c, best_axis = axis, best_plane = plane;
      }
    }
    if (best_axis < 0) return r.begin;
    const auto middle = std::stable_partition(at(r.begin), at(r.end), [&](std::uint32_t light) {
      return slab(bounds_(light), best_axis) < best_plane;
    });
    return static_cast<std::size_t>(middle - order_.begin());
  }

  std::vector<std::uint32_t>::iterator at(std::size_t i) {
    return order_.begin() + static_cast<std::ptrdiff_t>(i);
  }

  LightCluster build_node(std::size_t index, Range all, int depth) {
    std::array<Range, LightNode::width> parts{all};
    std::size_t count = 1;
    const auto end = [&] { return parts.begin() + static_cast<std::ptrdiff_t>(count); };
    while (count < LightNode::width) {
      const auto largest =
          std::max_element(parts.begin(), end(), [](Range a, Range b) { return a.size() < b.size(); });
      // The last level but one has as few nodes as hold its lights.
      if (largest->size() < 2 || (all.size() > LightNode::width && largest->size() <= LightNode::width))
        break;
      std::copy_backward(largest + 1, end(), end() + 1);
      largest[1] = split_off(*largest, depth);
      ++count;
    }

    LightNode node;
    node.first.fill(static_cast<std::uint32_t>(all.end));
    node.children = static_cast<std::uint32_t>(tree_.nodes_.size());
    std::uint8_t inner = 0;
    for (std::size_t lane = 0; lane < count; ++lane) {
      node.first[lane] = static_cast<std::uint32_t>(parts[lane].begin);
      if (parts[lane].size() > 1) node.below[lane] = inner++;
    }
    tree_.nodes_.resize(tree_.nodes_.size() + inner);
    LightCluster sum;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Range r = parts[lane];
      const LightCluster part = r.size() == 1 ? cluster_of(bounds_(order_[r.begin]))
                                              : build_node(node.children + node.below[lane], r, depth + 1);
      set_lane(node, lane, part);
      sum = united(sum, part);
    }
    tree_.nodes_[index] = node;
    return sum;
  }

  void list_slots() {
    double sum = 0;
    tree_.sums_.reserve(order_.size() + 1);
    for (std::uint32_t slot = 0; slot < order_.size(); ++slot) {
      tree_.slot_[order_[slot]] = slot;
      tree_.sums_.push_back(sum / tree_.power_);
      sum += bounds_(order_[slot]).power;
    }
    tree_.sums_.push_back(sum / tree_.power_);
    tree_.order_ = std::move(order_);
  }

  // Angles grow by what rounding may lose: 1/32767 of an axis, and of a cosine as much as θ_o needs.
  void set_lane(LightNode& node, std::size_t lane, const LightCluster& c) const {
    const Point3f middle = tree_.local(center(c.box));
    node.center_x[lane] = middle.x;
    node.center_y[lane] = middle.y;
    node.center_z[lane] = middle.z;
    const double radius = length(extent(c.box)) / 2 * tree_.scale_ * (1 + 1e-6) + 1e-7;
    const double half = c.cone.half_rad + 4e-5;
    const double cosine = half < pi ? portable_cos(half) : -1;
    constexpr auto unit = static_cast<double>(LightNode::unit);
    const auto integer = [](double x) { return std::nearbyint(x * unit); };
    node.axis_xy[lane] = pair(integer(c.cone.axis.x), integer(c.cone.axis.y));
    node.axis_z_cos_o[lane] = pair(integer(c.cone.axis.z), std::max(-32767.0, std::floor(cosine * unit)));
    // Power is of a bounded size, so that sums do not overflow; enough to be above 0.
    const bool narrow = c.theta_e_rad < narrow_rad;
    node.radius2_power[lane] = upper_bits(radius * radius) | (c.two_sided ? 0x8000u : 0u) |
                               (upper_bits(std::max(c.power / tree_.power_, 1e-30)) | (narrow ? 0x8000u : 0u))
                                   << 16;
    // So small that the square of the largest float is not reached: no distance is.
    const double near2 = std::min(c.power / c.amid * (tree_.scale_ * tree_.scale_), 1e30);
    node.near2[lane] = static_cast<std::uint16_t>(upper_bits(near2));
    if (!narrow && cosine > 0 && c.least_power >= least_share * tree_.power_)
      node.below[lane] |= LightNode::alike;
  }

  LightTree& tree_;
  std::size_t count_;
  const LightTree::BoundsOf& bounds_;
  std::vector<std::uint32_t> order_;
  std::vector<double> cap_;  // of each light: the mean resultant length of its own cone, (1 + cos θ_o)/2
};

LightTree::LightTree(std::size_t lights, const BoundsOf& bounds, LightChoice choice) : choice_(choice) {
  LightTreeBuilder(*this, lights, bounds).build();
}

LightTree::LightTree(std::span<const LightBounds> lights, LightChoice choice)
    : LightTree(
          lights.size(), [&](std::uint32_t i) { return lights[i]; }, choice) {}

}  // namespace vitrail
