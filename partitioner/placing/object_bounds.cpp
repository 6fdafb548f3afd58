// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/object_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/shapes/curve.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

double row_sum(const std::array<double, 4>& row) {
  return std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]);
}

// Outwards.
Bounds3f rounded(const Bounds3d& box) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Bounds3f out;
  for (int axis = 0; axis < 3; ++axis) {
    out.lower[axis] = std::nextafter(static_cast<float>(box.lower[axis]), -infinity);
    out.upper[axis] = std::nextafter(static_cast<float>(box.upper[axis]), infinity);
  }
  return out;
}

Transform transform_of(const Affine& a) {
  Transform t;
  for (std::size_t i = 0; i < 3; ++i) std::copy_n(a.m[i], 4, t.m[i].begin());
  return t;
}

// Throws Error for a box that floats cannot hold: with the vertex, where there is one.
Bounds3d checked(const Bounds3d& box, const Placement& p) {
  if (box.empty() || (is_finite(cast<float>(box.lower)) && is_finite(cast<float>(box.upper)))) return box;
  TriangleMesh storage;
  const TriangleMesh& mesh = loaded(*p.mesh, storage);
  const PlacementRule rule;
  const ReflectanceFitter fitter;
  PlacedTriangles placed = make_room(rule, mesh.triangles.size());
  MeshPlacer(p, mesh, rule, fitter).place(0, mesh.triangles.size(), placed, 0);
  throw Error("a shape reaches beyond 3.4e38 in the world", {});
}

}  // namespace

double greatest_row(const Transform& t) {
  return std::max({row_sum(t.m[0]), row_sum(t.m[1]), row_sum(t.m[2])});
}

Bounds3d transformed(const Transform& t, const Bounds3d& box) {
  Bounds3d out;
  for (int corner = 0; corner < 8 && !box.empty(); ++corner)
    extend(out,
           transform_point(t, {(corner & 1 ? box.upper : box.lower).x, (corner & 2 ? box.upper : box.lower).y,
                               (corner & 4 ? box.upper : box.lower).z}));
  return out;
}

Bounds3d world_bounds(const Placement& p) {
  const Bounds3f own = bounds_of(*p.mesh);
  Bounds3d box;
  for (int corner = 0; corner < 8 && !own.empty(); ++corner) {
    const auto at = [&](int axis) { return double{(corner >> axis & 1 ? own.upper : own.lower)[axis]}; };
    extend(box, transform_point(p.to_world, {at(0), at(1), at(2)}));
  }
  return checked(box, p);
}

FramePart part_of(const Placement& p) {
  const MeshFocus focus = focus_of(*p.mesh);
  return {transform_point(p.to_world, focus.centre), greatest_row(p.to_world) * focus.radius,
          static_cast<double>(triangles_of(*p.mesh))};
}

FramePart part_of(const std::vector<Assembly>& objects, const ObjectUse& use) {
  const auto& m = use.to_parent.m;
  const Assembly& object = objects[use.object];
  const auto row = [&](std::size_t i) { return std::abs(m[i][0]) + std::abs(m[i][1]) + std::abs(m[i][2]); };
  if (object.motion || (object.quadric && is_curve(*object.quadric->mesh->quadric))) {
    const Bounds3d box = box_of(objects, use);
    return {center(box), greatest(extent(box)) / 2, static_cast<double>(object.triangles)};
  }
  return {{m[0][3], m[1][3], m[2][3]},
          std::max({row(0), row(1), row(2)}) * object.radius,
          static_cast<double>(object.triangles)};
}

FramePart part_of(const QuadricRun& run) {
  const Transform t = transform_of(run.to_parent);
  return {transform_point(t, run.places->centre()), greatest_row(t) * run.places->radius(),
          static_cast<double>(run.places->size())};
}

Bounds3d box_of(const QuadricRun& run) {
  const Bounds3d box = transformed(transform_of(run.to_parent), run.places->bounds());
  if (!is_finite(cast<float>(box.lower)) || !is_finite(cast<float>(box.upper)))
    throw Error("a shape reaches beyond 3.4e38 in the world");
  return box;
}

Bounds3d box_of(const std::vector<Assembly>& objects, const ObjectUse& use) {
  const Assembly& object = objects[use.object];
  const Bounds3f& b = object.bounds;
  const Transform t = transform_of(use.to_parent);
  const Bounds3d box = object.quadric ? vitrail::bounds_of(*object.quadric->mesh->quadric, t)
                                      : transformed(t, {cast<double>(b.lower), cast<double>(b.upper)});
  if (!is_finite(cast<float>(box.lower)) || !is_finite(cast<float>(box.upper)))
    throw Error(
        "an instance has vertices that are not finite in the world; every coordinate has to be "
        "finite and below 3.4e38");
  return box;
}

Bounds3f placed_bounds(const Quadric& quadric, const Affine& to_parent) {
  return rounded(bounds_of(quadric, transform_of(to_parent)));
}

Bounds3f swept(const Motion& motion, const Bounds3d& box) { return rounded(motion.swept(box)); }

Bounds3f placed_bounds(const Assembly& object, const Affine& to_parent) {
  return object.quadric ? placed_bounds(*object.quadric->mesh->quadric, to_parent)
                        : placed_bounds(to_parent, object.bounds);
}

}  // namespace vitrail
