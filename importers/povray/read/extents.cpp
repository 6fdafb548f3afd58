// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/extents.h"

#include <algorithm>
#include <cmath>

#include "importers/povray/read/object.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

namespace {

constexpr double far = 1e7;
const Bounds3d everything{{-far, -far, -far}, {far, far, far}};

Bounds3d around(Point3d center, double radius) {
  const Vector3d r{radius, radius, radius};
  return {center - r, center + r};
}

// Of a plane across an axis, the half of space that it keeps.
Bounds3d half_of(const Object& object, const PlaneShape& plane) {
  const Vector3d n = to_vector(transform_normal(object.to_parent, to_normal(plane.normal)));
  const Point3d on = transform_point(object.to_parent, Point3d{} + plane.normal * plane.distance);
  Bounds3d half = everything;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(n[axis]) < (1 - 1e-12) * length(n)) continue;
    ((n[axis] > 0) != object.inverse ? half.upper : half.lower)[axis] = on[axis];
  }
  return half;
}

// Of a disc across `axis`.
Bounds3d around_disc(Point3d center, Vector3d axis, double radius) {
  const Vector3d n = normalize(axis);
  const auto reach = [&](double c) { return radius * std::sqrt(std::max(0.0, 1 - c * c)); };
  const Vector3d r{reach(n.x), reach(n.y), reach(n.z)};
  return {center - r, center + r};
}

// Of a set that may go on for ever: what reaches the sides of a cube does.
Bounds3d endless_box(const solids::Unbounded& set) {
  constexpr double near = 20;
  const solids::Solid solid = set({{-near, -near, -near}, {near, near, near}});
  Bounds3d box;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t)
    if (solid.surfaces[t] != solids::unseen)
      for (const std::uint32_t corner : solid.triangles[t]) extend(box, solid.positions[corner]);
  for (int axis = 0; axis < 3 && !box.empty(); ++axis) {
    if (box.lower[axis] <= -near) box.lower[axis] = -far;
    if (box.upper[axis] >= near) box.upper[axis] = far;
  }
  return box;
}

Bounds3d shape_box(const Object& object) {
  if (const auto* s = std::get_if<SphereShape>(&object.shape)) return around(s->center, s->radius);
  if (const auto* s = std::get_if<BoxShape>(&object.shape)) {
    Bounds3d box;
    extend(box, s->corner1);
    extend(box, s->corner2);
    return box;
  }
  if (const auto* s = std::get_if<ConeShape>(&object.shape)) {
    Bounds3d box = around_disc(s->base, s->cap - s->base, s->base_radius);
    extend(box, around_disc(s->cap, s->cap - s->base, s->cap_radius));
    return box;
  }
  if (const auto* s = std::get_if<DiscShape>(&object.shape))
    return around_disc(s->center, s->normal, s->radius);
  if (const auto* s = std::get_if<MeshShape>(&object.shape)) {
    Bounds3d box;
    for (const auto& part : s->parts)
      for (const Point3f& p : part.mesh->positions) extend(box, cast<double>(p));
    return box;
  }
  if (const auto* s = std::get_if<SolidShape>(&object.shape)) {
    if (s->box) return *s->box;
    if (s->unbounded) return endless_box(*s->unbounded);
    try {
      return s->make ? solids::bounds_of(s->make()) : everything;
    } catch (const Error&) {
      return {};
    }
  }
  if (const auto* group = std::get_if<GroupShape>(&object.shape)) {
    Bounds3d box;
    bool first = true;
    for (const auto& child : object.children) {
      const Bounds3d one = region_of(*child);
      if (group->kind == Word::difference_) {
        if (first) box = one;
      } else if (group->kind == Word::intersection_) {
        box = first ? one : common(box, one);
      } else if (!one.empty()) {
        extend(box, one);
      }
      first = false;
    }
    return box;
  }
  if (std::holds_alternative<PlaneShape>(object.shape)) return everything;
  return {};
}

}  // namespace

Bounds3d region_of(const Object& object) {
  if (const auto* plane = std::get_if<PlaneShape>(&object.shape)) return half_of(object, *plane);
  return object.inverse ? everything : extents_of(object);
}

Bounds3d moved_box(const Bounds3d& box, const Transform& t) {
  if (box.empty()) return box;
  Bounds3d result;
  for (int i = 0; i < 8; ++i)
    extend(result, transform_point(t, {i & 1 ? box.lower.x : box.upper.x, i & 2 ? box.lower.y : box.upper.y,
                                       i & 4 ? box.lower.z : box.upper.z}));
  return result;
}

const Bounds3d& own_box(const Object& object) {
  if (!object.box) object.box = shape_box(object);
  return *object.box;
}

Bounds3d extents_of(const Object& object) { return moved_box(own_box(object), object.to_parent); }

}  // namespace vitrail::pov
