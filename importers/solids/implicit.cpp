// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/implicit.h"

#include <algorithm>
#include <cmath>

#include "importers/solids/halving.h"
#include "importers/solids/marching.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

// Takes points to the zero, to what closes it, or to both.
class Zero {
 public:
  Zero(const Implicit& implicit, double cell, double tolerance)
      : implicit_(implicit), step_(1e-3 * cell), most_(cell), tolerance_(tolerance) {}

  std::optional<Point3d> operator()(const Point3d& from, Lies on) const {
    const auto* sphere = std::get_if<ContainingSphere>(&implicit_.container);
    if (!(on & on_zero)) {
      if (sphere) return on_surface(*sphere, from);
      return std::nullopt;  // sides are flat
    }
    Point3d p = from;
    for (int i = 0; i < 6; ++i) {
      if (sphere && on & on_sphere) p = on_surface(*sphere, p);
      const double f = implicit_.field(p);
      Vector3d g = slope_at(p, f);
      if (!sphere) keep_to_sides(g, on);
      const double slope = dot(g, g);
      if (!std::isfinite(f) || !std::isfinite(slope) || !(slope > 0)) return std::nullopt;
      Vector3d by = g * (-f / slope);
      const double far = length(by);
      if (far > most_) by = by * (most_ / far);
      p = p + by;
      if (far < 0.05 * tolerance_) break;
      if (i == 5 && far > 0.5 * tolerance_) return std::nullopt;
    }
    if (sphere && on & on_sphere) return on_surface(*sphere, p);
    if (!sphere) p = within(p);
    return p;
  }

  // By differences to either side.
  Vector3d gradient(const Point3d& p) const {
    const auto along = [&](int axis) {
      Point3d low = p, high = p;
      low[axis] -= step_;
      high[axis] += step_;
      return (implicit_.field(high) - implicit_.field(low)) / (2 * step_);
    };
    return {along(0), along(1), along(2)};
  }

 private:
  // By differences to one side of a value.
  Vector3d slope_at(const Point3d& p, double f) const {
    const auto along = [&](int axis) {
      Point3d high = p;
      high[axis] += step_;
      return (implicit_.field(high) - f) / step_;
    };
    return {along(0), along(1), along(2)};
  }
  static Point3d on_surface(const ContainingSphere& sphere, const Point3d& p) {
    const Vector3d v = p - sphere.center;
    const double size = length(v);
    return size > 0 ? sphere.center + v * (sphere.radius / size) : p;
  }
  static void keep_to_sides(Vector3d& g, Lies on) {
    for (int axis = 0; axis < 3; ++axis)
      if (on & (on_first_side * 3) << (2 * axis)) g[axis] = 0;
  }
  Point3d within(Point3d p) const {
    const auto& box = std::get<Bounds3d>(implicit_.container);
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::clamp(p[axis], box.lower[axis], box.upper[axis]);
    return p;
  }

  const Implicit& implicit_;
  double step_, most_, tolerance_;
};

void check(const Implicit& implicit) {
  if (const auto* sphere = std::get_if<ContainingSphere>(&implicit.container)) {
    if (!is_finite(sphere->center) || !std::isfinite(sphere->radius) || !(sphere->radius > 0))
      throw Error("a containing sphere has no finite place or size");
    return;
  }
  const auto& box = std::get<Bounds3d>(implicit.container);
  const Vector3d size = extent(box);
  if (!is_finite(box.lower) || !is_finite(box.upper) || !(size.x > 0 && size.y > 0 && size.z > 0))
    throw Error("a containing box has no finite place or size");
}

Vector3d side_normal(Lies lies) {
  Vector3d n;
  for (int axis = 0; axis < 3; ++axis)
    for (int high = 0; high < 2; ++high)
      if (lies & on_first_side << (2 * axis + high)) n[axis] = high ? 1 : -1;
  return n;
}

}  // namespace

Solid implicit(const Implicit& implicit, const Tessellation& tessellation) {
  check(implicit);
  March made = march(implicit);
  Solid solid;
  if (made.triangles.empty()) return solid;
  solid.positions = std::move(made.positions);
  const Vector3d size = extent(bounds_of(solid));
  const double tolerance = tessellation.deviation * std::max({size.x, size.y, size.z});
  const Zero zero(implicit, made.cell, tolerance);
  std::vector<Lies> on(solid.positions.size());
  for (std::size_t t = 0; t < made.triangles.size(); ++t)
    for (const std::uint32_t v : made.triangles[t]) on[v] |= made.lies[t];
  for (std::size_t v = 0; v < on.size(); ++v)
    if (on[v] & on_zero) solid.positions[v] = zero(solid.positions[v], on[v]).value_or(solid.positions[v]);
  halve(solid.positions, made.triangles, made.lies, zero,
        {.tolerance = tolerance, .rounds = implicit.most_halvings});
  solid.triangles = std::move(made.triangles);

  std::vector<Vector3d> gradients(solid.positions.size());
  std::vector<bool> is_known(solid.positions.size());
  const auto* sphere = std::get_if<ContainingSphere>(&implicit.container);
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const auto& corners = solid.triangles[t];
    const Point3d a = solid.positions[corners[0]];
    const Vector3d front = cross(solid.positions[corners[1]] - a, solid.positions[corners[2]] - a);
    const bool is_cap = !(made.lies[t] & on_zero);
    std::array<Normal3f, 3> normals{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = corners[i];
      Vector3d n;
      if (is_cap) {
        n = sphere ? normalize(solid.positions[v] - sphere->center) : side_normal(made.lies[t]);
      } else {
        if (!is_known[v]) gradients[v] = normalize(zero.gradient(solid.positions[v]));
        is_known[v] = true;
        n = gradients[v];
        // Where the function has a crease or a jump: the triangle's.
        if (!(dot(n, front) > 0.5 * length(front))) n = normalize(front);
        if (!(length(n) > 0.5)) n = {0, 0, 1};  // of no area
      }
      normals[i] = cast<float>(to_normal(n));
    }
    solid.normals.push_back(normals);
    solid.surfaces.push_back(is_cap && implicit.open ? unseen : 0);
  }
  return solid;
}

}  // namespace vitrail::solids
