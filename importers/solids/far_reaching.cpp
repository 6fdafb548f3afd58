// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "importers/solids/implicit.h"
#include "scene/geometry/portable_math.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

// A coordinate of the lattice, and how fast the place goes with it. Beyond `near` it grows as e^u, so that
// cells are as large for their distance as there.
struct Stretch {
  double near;

  double place(double u) const {
    return std::abs(u) <= near ? u : std::copysign(near * portable_exp(std::abs(u) / near - 1), u);
  }
  double slope(double u) const { return std::abs(u) <= near ? 1 : std::abs(place(u)) / near; }
  Point3d place(const Point3d& u) const { return {place(u.x), place(u.y), place(u.z)}; }
};

}  // namespace

Solid far_reaching(const Field& field, double near, double far, const Tessellation& tessellation) {
  if (!(near > 0 && far > near)) throw Error("a surface does not reach farther than near");
  const Stretch stretch{near};
  const double edge = near * (1 + portable_log(far / near));
  Implicit implicit;
  implicit.field = [&](const Point3d& u) { return field(stretch.place(u)); };
  implicit.container = Bounds3d{{-edge, -edge, -edge}, {edge, edge, edge}};
  implicit.open = true;
  implicit.cells = 160;
  implicit.most_halvings = 2;
  Solid solid = solids::implicit(implicit, {tessellation.deviation * near / edge});
  for (std::size_t t = 0; t < solid.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3d u = solid.positions[solid.triangles[t][i]];
      const Vector3d n = to_vector(cast<double>(solid.normals[t][i]));
      const Vector3d turned{n.x / stretch.slope(u.x), n.y / stretch.slope(u.y), n.z / stretch.slope(u.z)};
      solid.normals[t][i] = cast<float>(to_normal(normalize(turned)));
    }
  for (Point3d& p : solid.positions) p = stretch.place(p);
  return solid;
}

}  // namespace vitrail::solids
