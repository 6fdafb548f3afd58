// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/placed_quadric.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/records/kinds.h"
#include "scene/shapes/tessellate.h"

namespace vitrail {

namespace {

constexpr double tolerance = 1e-6;

bool are_equal(double a, double b) { return std::abs(a - b) <= tolerance * std::max(a, b); }

}  // namespace

bool is_whole(const Quadric& q) {
  const bool has_hole = q.kind == QuadricKind::sphere ? !is_whole_sphere(q)
                        : q.kind == QuadricKind::disk ? q.low > 0
                                                      : q.kind == QuadricKind::paraboloid && q.low > 0;
  return is_whole_turn(q) && !has_hole;
}

std::optional<QuadricShape> placed_quadric(const Scene& scene, const Shape& shape, QuadricUv uv,
                                           ShapeUvUses& uvs) {
  const std::optional<Quadric>& quadric = scene.meshes.at(shape.mesh.value).quadric;
  if (!quadric || is_curve(*quadric)) return std::nullopt;
  QuadricShape q{*quadric, shape.object_to_world, shape.flip_orientation};
  const bool differs = q.quadric.uv != uv && uvs.of(shape);
  q.quadric.uv = uv;
  if (!differs) return q;
  if (q.quadric.kind == QuadricKind::disk) return std::nullopt;
  if (q.quadric.kind == QuadricKind::sphere) {
    q.quadric.low = -quadric->high;
    q.quadric.high = -quadric->low;
    q.to_world = q.to_world * scale({1, 1, -1});
    q.flip_orientation = !q.flip_orientation;
  }
  return q;
}

bool Axes::keep_circles() const { return perpendicular && are_equal(x, y); }
bool Axes::keep_spheres() const { return keep_circles() && are_equal(x, z); }

Axes axes_of(const Transform& t) {
  const auto axis = [&](std::size_t i) { return Vector3d{t.m[0][i], t.m[1][i], t.m[2][i]}; };
  const Vector3d x = axis(0), y = axis(1), z = axis(2);
  Axes axes{length(x), length(y), length(z)};
  axes.perpendicular = std::abs(dot(x, y)) <= tolerance * axes.x * axes.y &&
                       std::abs(dot(x, z)) <= tolerance * axes.x * axes.z &&
                       std::abs(dot(y, z)) <= tolerance * axes.y * axes.z;
  return axes;
}

std::string as_triangles(const Quadric& q) {
  if (is_curve(q)) return "curves become tubes of triangles";
  return fmt::format("a {}{} becomes triangles, {} for a full turn", is_whole(q) ? "" : "partial ",
                     kind_of(q.kind), quadric_segments);
}

}  // namespace vitrail
