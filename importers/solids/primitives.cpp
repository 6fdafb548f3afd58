// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/primitives.h"

#include <cmath>

#include "importers/solids/revolution.h"
#include "scene/geometry/frame.h"
#include "scene/geometry/portable_math.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

void check(bool good, const char* what) {
  if (!good) throw Error(what);
}

bool is_size(double size) { return std::isfinite(size) && size > 0; }

// y becomes `axis`, a unit vector, and the origin `base`.
Solid placed(Solid solid, Point3d base, Vector3d axis) {
  const Frame frame(axis);
  const auto turned = [&](Vector3d v) {
    return frame.tangent * v.x + frame.normal * v.y - frame.bitangent * v.z;
  };
  for (Point3d& p : solid.positions) p = base + turned(p - Point3d{});
  for (auto& triangle : solid.normals)
    for (Normal3f& n : triangle) n = cast<float>(to_normal(turned(to_vector(cast<double>(n)))));
  return solid;
}

}  // namespace

Solid box(Point3d corner1, Point3d corner2) {
  check(is_finite(corner1) && is_finite(corner2), "a box is not finite");
  Bounds3d b;
  extend(b, corner1);
  extend(b, corner2);
  const Vector3d size = extent(b);
  check(size.x > 0 && size.y > 0 && size.z > 0, "a box is flat");
  Solid solid;
  for (int i = 0; i < 8; ++i)
    solid.positions.push_back(
        {i & 1 ? b.upper.x : b.lower.x, i & 2 ? b.upper.y : b.lower.y, i & 4 ? b.upper.z : b.lower.z});
  // Each side counter-clockwise seen from outside.
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (std::size_t side = 0; side < 6; ++side) {
    Vector3f normal;
    normal[static_cast<int>(side / 2)] = side % 2 ? 1.0f : -1.0f;
    const auto& [p, q, r, s] = sides[side];
    solid.triangles.push_back({p, q, r});
    solid.triangles.push_back({p, r, s});
    const Normal3f n = to_normal(normal);
    solid.normals.insert(solid.normals.end(), 2, {n, n, n});
  }
  solid.surfaces.assign(12, 0);
  return solid;
}

Solid sphere(Point3d center, double radius, const Tessellation& tessellation) {
  check(is_finite(center) && is_size(radius), "a sphere has no finite place or size");
  const double tolerance = tessellation.deviation * 2 * radius / 2;
  std::vector<MeridianChord> chords;
  append_arc(chords, {0, 0}, radius, -pi / 2, pi / 2, tolerance);
  chords.front().from.x = chords.back().to.x = 0;
  Solid solid = revolve(chords, circle_chords(radius, tolerance));
  for (Point3d& p : solid.positions) p = p + (center - Point3d{});
  return solid;
}

Solid cone(const Cone& cone, const Tessellation& tessellation) {
  const double r1 = cone.base_radius, r2 = cone.cap_radius;
  const Vector3d along = cone.cap_point - cone.base_point;
  const double height = length(along), widest = std::max(r1, r2);
  check(is_size(height) && std::isfinite(r1) && std::isfinite(r2) && r1 >= 0 && r2 >= 0 && widest > 0,
        "a cone or cylinder has no finite place or size");
  std::vector<MeridianChord> chords;
  const std::uint32_t cap = cone.open ? unseen : 0;
  if (r1 > 0) append_line(chords, {0, 0}, {r1, 0}, cap);
  append_line(chords, {r1, 0}, {r2, height});
  if (r2 > 0) append_line(chords, {r2, height}, {0, height}, cap);
  const double tolerance = tessellation.deviation * std::max(height, 2 * widest);
  Solid solid =
      placed(revolve(chords, circle_chords(widest, tolerance)), cone.base_point, along * (1 / height));
  return solid;
}

Solid cylinder(Point3d base_point, Point3d cap_point, double radius, bool open,
               const Tessellation& tessellation) {
  return cone({base_point, radius, cap_point, radius, open}, tessellation);
}

Solid disc(Point3d center, Vector3d normal, double radius, double hole_radius,
           const Tessellation& tessellation) {
  check(is_finite(center) && is_size(length(normal)) && is_size(radius) && hole_radius >= 0 &&
            hole_radius < radius,
        "a disc has no finite place, normal or size");
  std::vector<MeridianChord> chords;
  append_line(chords, {radius, 0}, {hole_radius, 0});
  Solid solid = placed(revolve(chords, circle_chords(radius, tessellation.deviation * 2 * radius)), center,
                       normalize(normal));
  solid.closed = false;
  return solid;
}

Solid torus(double major, double minor, const Tessellation& tessellation) {
  check(std::isfinite(major) && major >= 0 && is_size(minor), "a torus has no finite size");
  const double outer = major + minor, tolerance = tessellation.deviation * 2 * outer / 2;
  std::vector<MeridianChord> chords;
  if (minor < major) {
    append_arc(chords, {major, 0}, minor, 0, 2 * pi, tolerance);
    chords.back().to = chords.front().from;
  } else {
    const double end = pi - portable_acos(major / minor);  // where it meets the axis
    append_arc(chords, {major, 0}, minor, -end, end, tolerance);
    chords.front().from.x = chords.back().to.x = 0;
  }
  return revolve(chords, circle_chords(outer, tolerance));
}

Solid ovus(double bottom_radius, double top_radius, const Tessellation& tessellation) {
  check(is_size(bottom_radius) && std::isfinite(top_radius) && top_radius >= 0, "an ovus has no finite size");
  if (top_radius >= 2 * bottom_radius) return sphere({0, bottom_radius, 0}, top_radius, tessellation);
  const double widest = std::max(bottom_radius, top_radius), lemon = 2 * widest;
  const double tolerance = tessellation.deviation * std::max(2 * widest, 2 * bottom_radius + top_radius) / 2;
  // The lemon's arc touches both circles from outside: its centre is as far from theirs as the radii differ.
  const double to_bottom = lemon - bottom_radius, to_top = lemon - top_radius, apart = bottom_radius;
  const double y = (to_bottom * to_bottom - to_top * to_top + apart * apart) / (2 * apart);
  const double x = -std::sqrt(std::max(0.0, to_bottom * to_bottom - y * y));
  const double low = portable_atan2(-y, -x), high = portable_atan2(bottom_radius - y, -x);
  std::vector<MeridianChord> chords;
  append_arc(chords, {0, 0}, bottom_radius, -pi / 2, low, tolerance);
  append_arc(chords, {x, y}, lemon, low, high, tolerance);
  if (top_radius > 0) append_arc(chords, {0, bottom_radius}, top_radius, high, pi / 2, tolerance);
  for (std::size_t i = 1; i < chords.size(); ++i) chords[i].from = chords[i - 1].to;
  chords.front().from.x = chords.back().to.x = 0;
  return revolve(chords, circle_chords(widest, tolerance));
}

}  // namespace vitrail::solids
