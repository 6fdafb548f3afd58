// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "tracer/lights/light_tree.h"
#include "tracer/portable_math.h"

namespace vitrail {

namespace {

// A cone of directions around a unit axis; half angle π is the sphere.
struct Cone {
  Vector3d axis{0, 0, 1};
  double half_rad = 0;
};

Vector3d any_across(Vector3d v) {
  return normalize(std::abs(v.x) < 0.6 ? cross(v, Vector3d{1, 0, 0}) : cross(v, Vector3d{0, 1, 0}));
}

// The least cone around two.
Cone united(Cone a, Cone b) {
  if (a.half_rad < b.half_rad) std::swap(a, b);
  const double between = portable_acos(dot(a.axis, b.axis));
  if (std::min(between + b.half_rad, pi) <= a.half_rad) return a;
  const double half = (a.half_rad + between + b.half_rad) / 2;
  if (half >= pi) return {a.axis, pi};
  Vector3d across = b.axis - a.axis * dot(a.axis, b.axis);
  across = dot(across, across) > 1e-20 ? normalize(across) : any_across(a.axis);
  const double turn = half - a.half_rad;
  return {normalize(a.axis * portable_cos(turn) + across * portable_sin(turn)), half};
}

// Bounds of a set of lights. Two-sided normals are turned to one half space to be bounded.
struct Cluster {
  Bounds3d box;
  Cone cone;
  double theta_e_rad = 0, power = 0;
  bool two_sided = false;
  bool empty = true;
};

Cluster cluster_of(const LightBounds& l) {
  return {l.box, {l.axis, l.theta_o_rad}, l.theta_e_rad, l.power, l.two_sided, false};
}

Cluster united(const Cluster& a, const Cluster& b) {
  if (a.empty) return b;
  if (b.empty) return a;
  Cluster c = a;
  extend(c.box, b.box);
  // A set with a two-sided light counts as two-sided: it may be asked more often than it has light, never
  // less.
  c.two_sided = a.two_sided || b.two_sided;
  Cone second = b.cone;
  if (c.two_sided && dot(a.cone.axis, second.axis) < 0) second.axis = -second.axis;
  c.cone = united(a.cone, second);
  c.theta_e_rad = std::max(a.theta_e_rad, b.theta_e_rad);
  c.power += b.power;
  return c;
}

// M_Ω of Conty Estevez & Kulla 2018, eq. 1: the solid angle that is lit, weighted by the cosine beyond θ_o.
double solid_angle(const Cluster& c) {
  const double o = std::min(c.cone.half_rad, pi), w = std::min(o + c.theta_e_rad, pi);
  const double cos_o = portable_cos(o), sin_o = portable_sin(o);
  return 2 * pi * (1 - cos_o) + pi / 2 * (2 * w * sin_o - portable_cos(o - 2 * w) - 2 * o * sin_o + cos_o);
}

double cost(const Cluster& c) {
  if (c.empty) return 0;
  const Vector3d e = extent(c.box);
  return c.power * (surface_area(c.box) + 1e-3 * dot(e, e)) * solid_angle(c);
}

// Lights whose θ_e is less emit nothing beyond θ_o, as far as a node tells.
constexpr double narrow_rad = 0.014;
constexpr int buckets = 12;
// From here on by number, which needs at most 11 more levels for 2³² lights; a trail has room for 21.
constexpr int deepest_by_cost = 10;

}  // namespace

class LightTreeBuilder {
 public:
  LightTreeBuilder(LightTree& tree, std::span<const LightBounds> lights) : tree_(tree), lights_(lights) {}

  void build() {
    for (std::uint32_t i = 0; i < lights_.size(); ++i)
      if (lights_[i].power > 0 && std::isfinite(lights_[i].power)) order_.push_back(i);
    tree_.trail_.assign(lights_.size(), 0);
    if (order_.empty()) return;
    Bounds3d all;
    for (const std::uint32_t i : order_) {
      extend(all, lights_[i].box);
      tree_.power_ += lights_[i].power;
    }
    tree_.center_ = center(all);
    const Vector3d e = extent(all);
    const double half = std::max({e.x, e.y, e.z}) / 2;
    tree_.scale_ = half > 0 ? 1 / half : 1;
    build_node({0, order_.size()}, 0, 0);
  }

 private:
  struct Range {
    std::size_t begin = 0, end = 0;
    std::size_t size() const { return end - begin; }
  };

  Cluster bounds_of(Range r) const {
    Cluster c;
    for (std::size_t i = r.begin; i < r.end; ++i) c = united(c, cluster_of(lights_[order_[i]]));
    return c;
  }

  Range split_off(Range& r, int depth) {
    std::size_t middle = depth < deepest_by_cost ? cheapest_split(r) : r.begin;
    if (middle == r.begin || middle == r.end) middle = middle_split(r);
    const Range above{middle, r.end};
    r.end = middle;
    return above;
  }

  double coordinate(std::uint32_t light, int axis) const { return center(lights_[light].box)[axis]; }

  Bounds3d centers_of(Range r) const {
    Bounds3d b;
    for (std::size_t i = r.begin; i < r.end; ++i) extend(b, center(lights_[order_[i]].box));
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
    const auto slab = [&](std::uint32_t light, int axis) {
      const double x = (coordinate(light, axis) - centers.lower[axis]) / e[axis] * buckets;
      return std::clamp(static_cast<int>(x), 0, buckets - 1);
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (!(e[axis] > 1e-9 * longest)) continue;
      std::array<Cluster, buckets> slabs, above;
      for (std::size_t i = r.begin; i < r.end; ++i) {
        Cluster& s = slabs[static_cast<std::size_t>(slab(order_[i], axis))];
        s = united(s, cluster_of(lights_[order_[i]]));
      }
      above[buckets - 1] = slabs[buckets - 1];
      for (std::size_t i = buckets - 1; i-- > 0;) above[i] = united(slabs[i], above[i + 1]);
      Cluster below;
      for (int plane = 1; plane < buckets; ++plane) {
        const auto i = static_cast<std::size_t>(plane);
        below = united(below, slabs[i - 1]);
        if (below.empty || above[i].empty) continue;
        const double c = (cost(below) + cost(above[i])) * (longest / e[axis]);
        if (c < best) best = c, best_axis = axis, best_plane = plane;
      }
    }
    if (best_axis < 0) return r.begin;
    const auto middle = std::stable_partition(
        at(r.begin), at(r.end), [&](std::uint32_t light) { return slab(light, best_axis) < best_plane; });
    return static_cast<std::size_t>(middle - order_.begin());
  }

  std::vector<std::uint32_t>::iterator at(std::size_t i) {
    return order_.begin() + static_cast<std::ptrdiff_t>(i);
  }

  std::int32_t build_node(Range all, int depth, std::uint64_t trail) {
    std::array<Range, LightNode::width> parts{all};
    std::size_t count = 1;
    while (count < LightNode::width) {
      const auto largest = std::max_element(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
                                            [](Range a, Range b) { return a.size() < b.size(); });
      // The last level but one has as few nodes as hold its lights.
      if (largest->size() < 2 || (all.size() > LightNode::width && largest->size() <= LightNode::width))
        break;
      parts[count] = split_off(*largest, depth);
      ++count;
    }
    const auto index = static_cast<std::int32_t>(tree_.nodes_.size());
    tree_.nodes_.emplace_back();
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Range r = parts[lane];
      set_lane(index, lane, bounds_of(r));
      const std::uint64_t way = trail | static_cast<std::uint64_t>(lane) << 3 * depth;
      std::int32_t child;
      if (r.size() == 1) {
        const std::uint32_t light = order_[r.begin];
        tree_.trail_[light] = way | std::uint64_t{1} << 3 * (depth + 1);
        child = static_cast<std::int32_t>(~light);
      } else {
        child = build_node(r, depth + 1, way);
      }
      tree_.nodes_[static_cast<std::size_t>(index)].child[lane] = child;
    }
    return index;
  }

  // Angles grow by what rounding may lose: 1/32767 of an axis, and of a cosine as much as θ_o needs.
  void set_lane(std::int32_t index, std::size_t lane, const Cluster& c) {
    LightNode& node = tree_.nodes_[static_cast<std::size_t>(index)];
    const Point3f middle = tree_.local(center(c.box));
    node.center_x[lane] = middle.x;
    node.center_y[lane] = middle.y;
    node.center_z[lane] = middle.z;
    const double radius = length(extent(c.box)) / 2 * tree_.scale_ * (1 + 1e-6) + 1e-7;
    node.radius2[lane] = static_cast<float>(radius * radius) * (c.two_sided ? -1.0f : 1.0f);
    const auto integer = [](double x) {
      return static_cast<std::int16_t>(std::nearbyint(x * static_cast<double>(LightNode::unit)));
    };
    node.axis_x[lane] = integer(c.cone.axis.x);
    node.axis_y[lane] = integer(c.cone.axis.y);
    node.axis_z[lane] = integer(c.cone.axis.z);
    const double half = c.cone.half_rad + 4e-5;
    const double cosine = half < pi ? portable_cos(half) : -1;
    node.cos_o[lane] = static_cast<std::int16_t>(
        std::max(-32767.0, std::floor(cosine * static_cast<double>(LightNode::unit))));
    // Of a bounded size, so that sums do not overflow; enough to be above 0.
    const auto power = static_cast<float>(std::max(c.power / tree_.power_, 1e-30));
    node.power[lane] = c.theta_e_rad < narrow_rad ? -power : power;
  }

  LightTree& tree_;
  std::span<const LightBounds> lights_;
  std::vector<std::uint32_t> order_;
};

LightTree::LightTree(std::span<const LightBounds> lights, LightChoice choice) : choice_(choice) {
  LightTreeBuilder(*this, lights).build();
}

}  // namespace vitrail
