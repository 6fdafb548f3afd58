// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "importers/solids/boolean.h"
#include "importers/solids/grids.h"
#include "importers/solids/primitives.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

using Place = std::function<Point3d(double u, double v)>;

constexpr int fewest = 8, most = 512;

// Points on a lattice of the parameters.
struct Lattice {
  int nu = fewest, nv = fewest;
  std::vector<Point3d> points;  // (nu + 1)(nv + 1), a row of u after the other

  const Point3d& at(int i, int k) const {
    return points[static_cast<std::size_t>(k) * (static_cast<std::size_t>(nu) + 1) +
                  static_cast<std::size_t>(i)];
  }
};

class Surface {
 public:
  Surface(const Place& place, std::array<double, 2> from, std::array<double, 2> to)
      : place_(place), from_(from), to_(to) {}

  Point3d at(double s, double t) const {
    const Point3d p = place_(from_[0] + (to_[0] - from_[0]) * s, from_[1] + (to_[1] - from_[1]) * t);
    if (!is_finite(p)) throw Error("a parametric surface is not finite");
    return p;
  }

  Lattice lattice(int nu, int nv) const {
    Lattice made{nu, nv, {}};
    for (int k = 0; k <= nv; ++k)
      for (int i = 0; i <= nu; ++i)
        made.points.push_back(at(static_cast<double>(i) / nu, static_cast<double>(k) / nv));
    return made;
  }

  // Of ∂u × ∂v by differences; zero where there is none.
  Vector3d normal(double s, double t) const {
    constexpr double step = 1e-5;
    const auto clamped = [](double x) { return std::clamp(x, 0.0, 1.0); };
    const Vector3d du = at(clamped(s + step), t) - at(clamped(s - step), t);
    const Vector3d dv = at(s, clamped(t + step)) - at(s, clamped(t - step));
    const Vector3d n = cross(du, dv);
    const double size = length(du) * length(dv);
    return length(n) > 1e-6 * size ? normalize(n) : Vector3d{};
  }

  // The greatest distances of chords' middles from the surface, along u and along v.
  std::array<double, 2> deviations(const Lattice& l) const {
    std::array<double, 2> far{};
    const auto off = [](const Point3d& a, const Point3d& b, const Point3d& on) {
      const Vector3d chord = b - a, v = on - (a + chord * 0.5);
      const double whole = dot(chord, chord);
      return length(whole > 0 ? v - chord * (dot(v, chord) / whole) : v);
    };
    for (int k = 0; k <= l.nv; ++k)
      for (int i = 0; i <= l.nu; ++i) {
        const double s = static_cast<double>(i) / l.nu, t = static_cast<double>(k) / l.nv;
        if (i < l.nu) far[0] = std::max(far[0], off(l.at(i, k), l.at(i + 1, k), at(s + 0.5 / l.nu, t)));
        if (k < l.nv) far[1] = std::max(far[1], off(l.at(i, k), l.at(i, k + 1), at(s, t + 0.5 / l.nv)));
      }
    return far;
  }

 private:
  const Place& place_;
  std::array<double, 2> from_, to_;
};

double greatest_edge(const std::vector<Point3d>& points) {
  Bounds3d bounds;
  for (const Point3d& p : points) extend(bounds, p);
  const Vector3d size = extent(bounds);
  return std::max({size.x, size.y, size.z});
}

// As fine as the tolerance asks for along each parameter.
Lattice fine_lattice(const Surface& surface, double deviation) {
  Lattice l = surface.lattice(fewest, fewest);
  while (true) {
    const auto far = surface.deviations(l);
    // A square's middle is off by what both directions are.
    const double tolerance = deviation * greatest_edge(l.points) / 2;
    const bool finer_u = far[0] > tolerance && l.nu<most, finer_v = far[1]> tolerance && l.nv < most;
    if (!finer_u && !finer_v) return l;
    l = surface.lattice(finer_u ? 2 * l.nu : l.nu, finer_v ? 2 * l.nv : l.nv);
  }
}

Solid solid_of(const Surface& surface, const Lattice& l) {
  Solid solid;
  solid.closed = false;
  solid.positions = l.points;
  std::vector<Vector3d> normals;
  for (int k = 0; k <= l.nv; ++k)
    for (int i = 0; i <= l.nu; ++i)
      normals.push_back(surface.normal(static_cast<double>(i) / l.nu, static_cast<double>(k) / l.nv));
  const auto number = [&](int i, int k) { return static_cast<std::uint32_t>(k * (l.nu + 1) + i); };
  const auto add = [&](std::array<std::uint32_t, 3> t) {
    const Point3d a = solid.positions[t[0]];
    const Vector3d front = cross(solid.positions[t[1]] - a, solid.positions[t[2]] - a);
    if (!(length(front) > 0)) return;  // at a pole
    std::array<Normal3f, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d n = normals[t[i]];
      corner[i] = cast<float>(to_normal(dot(n, front) > 0 ? n : normalize(front)));
    }
    solid.triangles.push_back(t);
    solid.normals.push_back(corner);
    solid.surfaces.push_back(0);
  };
  for (int k = 0; k < l.nv; ++k)
    for (int i = 0; i < l.nu; ++i) {
      add({number(i, k), number(i + 1, k), number(i + 1, k + 1)});
      add({number(i, k), number(i + 1, k + 1), number(i, k + 1)});
    }
  return solid;
}

Solid container_solid(const Container& container) {
  if (const auto* s = std::get_if<ContainingSphere>(&container)) return sphere(s->center, s->radius);
  const auto& b = std::get<Bounds3d>(container);
  return box(b.lower, b.upper);
}

bool contains(const Container& container, const Point3d& p) {
  if (const auto* s = std::get_if<ContainingSphere>(&container)) return length(p - s->center) <= s->radius;
  const auto& b = std::get<Bounds3d>(container);
  return p.x >= b.lower.x && p.x <= b.upper.x && p.y >= b.lower.y && p.y <= b.upper.y && p.z >= b.lower.z &&
         p.z <= b.upper.z;
}

// Triangles whose middle is outside: where an exact cut is refused.
void drop_outside(Solid& solid, const Container& container) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const auto& [a, b, c] = solid.triangles[t];
    const Point3d p = solid.positions[a];
    const Vector3d sides = (solid.positions[b] - p) + (solid.positions[c] - p);
    if (!contains(container, p + sides * (1.0 / 3))) continue;
    solid.triangles[kept] = solid.triangles[t];
    solid.normals[kept] = solid.normals[t];
    solid.surfaces[kept++] = solid.surfaces[t];
  }
  solid.triangles.resize(kept);
  solid.normals.resize(kept);
  solid.surfaces.resize(kept);
}

}  // namespace

Solid parametric(const Parametric& parametric, const Tessellation& tessellation) {
  const Surface surface(parametric.place, parametric.from, parametric.to);
  Solid made = solid_of(surface, fine_lattice(surface, tessellation.deviation));
  if (!parametric.contained_by) return made;
  const Container& container = *parametric.contained_by;
  if (std::ranges::all_of(made.positions, [&](const Point3d& p) { return contains(container, p); }))
    return made;
  BooleanResult cut = cut_surface(made, container_solid(container), true);
  if (cut.solid) return std::move(*cut.solid);
  drop_outside(made, container);
  return made;
}

Solid bicubic_patch(const std::array<Point3d, 16>& points, const Tessellation& tessellation) {
  const auto bernstein = [](double t) {
    const double s = 1 - t;
    return std::array{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  };
  return parametric({.place =
                         [&](double u, double v) {
                           const auto bu = bernstein(u), bv = bernstein(v);
                           Vector3d sum;
                           for (std::size_t k = 0; k < 4; ++k)
                             for (std::size_t i = 0; i < 4; ++i)
                               sum = sum + (points[4 * k + i] - Point3d{}) * (bu[i] * bv[k]);
                           return Point3d{} + sum;
                         }},
                    tessellation);
}

}  // namespace vitrail::solids
