// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "importers/solids/halving.h"
#include "importers/solids/primitives.h"
#include "scene/geometry/portable_math.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

class Superellipsoid {
 public:
  Superellipsoid(double e, double n) : e_(e), n_(n) {}

  // Where the ray from the middle through `p` meets it. The form is taken relative to its greatest terms, so
  // that no power is too large.
  Point3d on(const Point3d& p) const {
    const double xy = radius_xy(p), most = std::max(xy, std::abs(p.z));
    const double sum = portable_pow(xy / most, 2 / n_) + portable_pow(std::abs(p.z) / most, 2 / n_);
    return Point3d{} + (p - Point3d{}) * (1 / (most * portable_pow(sum, n_ / 2)));
  }

  // Along the gradient: each power's derivative, relative to the greatest.
  Normal3f normal(const Point3d& p) const {
    const double xy = radius_xy(p);
    const auto slope = [&](double x) {  // of the xy part
      if (xy == 0 || x == 0) return 0.0;
      return std::copysign(portable_pow(std::abs(x) / xy, 2 / e_ - 1), x) * portable_pow(xy, 2 / n_ - 1);
    };
    const double z = p.z == 0 ? 0 : std::copysign(portable_pow(std::abs(p.z), 2 / n_ - 1), p.z);
    return cast<float>(to_normal(normalize(Vector3d{slope(p.x), slope(p.y), z})));
  }

 private:
  double radius_xy(const Point3d& p) const {
    const double x = std::abs(p.x), y = std::abs(p.y), most = std::max(x, y);
    if (most == 0) return 0;
    return most * portable_pow(portable_pow(x / most, 2 / e_) + portable_pow(y / most, 2 / e_), e_ / 2);
  }

  double e_, n_;
};

// A cube of 6 × cells² squares, two triangles each.
void append_cube(int cells, std::vector<Point3d>& positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::map<std::array<int, 3>, std::uint32_t> vertices;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [known, is_new] = vertices.try_emplace(at, static_cast<std::uint32_t>(positions.size()));
    if (is_new)
      positions.push_back({2.0 * at[0] / cells - 1, 2.0 * at[1] / cells - 1, 2.0 * at[2] / cells - 1});
    return known->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true})
      for (int i = 0; i < cells; ++i)
        for (int k = 0; k < cells; ++k) {
          const auto corner = [&](int u, int v) {
            std::array<int, 3> at{};
            at[axis] = high ? cells : 0;
            at[(axis + 1) % 3] = i + u;
            at[(axis + 2) % 3] = k + v;
            return vertex(at);
          };
          std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (!high) std::swap(b, d);
          // The diagonal runs towards the middle of the side: what is symmetric comes out so.
          const bool other = (2 * i < cells) != (2 * k < cells);
          triangles.push_back(other ? std::array{a, b, d} : std::array{a, b, c});
          triangles.push_back(other ? std::array{b, c, d} : std::array{a, c, d});
        }
}

}  // namespace

Solid superellipsoid(double e, double n, const Tessellation& tessellation) {
  if (!(e > 0) || !(n > 0) || !std::isfinite(e) || !std::isfinite(n))
    throw Error("a superellipsoid's exponents are not positive");
  const Superellipsoid shape(std::clamp(e, 0.01, 8.0), std::clamp(n, 0.01, 8.0));
  Solid solid;
  append_cube(12, solid.positions, solid.triangles);
  for (Point3d& p : solid.positions) p = shape.on(p);
  std::vector<Lies> lies(solid.triangles.size(), 0);
  halve(solid.positions, solid.triangles, lies, [&](const Point3d& p, Lies) { return shape.on(p); },
        {.tolerance = tessellation.deviation * 2, .rounds = 10, .most_triangles = 1'000'000});
  solid.surfaces.assign(solid.triangles.size(), 0);
  for (const auto& t : solid.triangles) {
    const Point3d a = solid.positions[t[0]];
    const Vector3d front = cross(solid.positions[t[1]] - a, solid.positions[t[2]] - a);
    std::array<Normal3f, 3> normals{};
    for (std::size_t i = 0; i < 3; ++i) {
      normals[i] = shape.normal(solid.positions[t[i]]);
      // At a spike or a sharp edge the surface has no normal: the triangle's.
      if (dot(to_vector(cast<double>(normals[i])), front) < 0.5 * length(front))
        normals[i] = cast<float>(to_normal(normalize(front)));
    }
    solid.normals.push_back(normals);
  }
  return solid;
}

}  // namespace vitrail::solids
