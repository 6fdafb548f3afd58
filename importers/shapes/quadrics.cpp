// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/shapes/shapes.h"
#include "importers/shapes/unit_circle.h"

namespace vitrail {

namespace {

void require(bool holds, const char* shape, const char* quantity, double value, const char* what) {
  if (!holds) throw Error(fmt::format("{}: {} is {}, but has to be {}", shape, quantity, value, what));
}

void require_size(double value, const char* shape, const char* quantity) {
  require(value > 0 && std::isfinite(value), shape, quantity, value, "finite and above 0");
  require(std::isfinite(static_cast<float>(value)), shape, quantity, value, "a single-precision number");
}

void require_finite(double value, const char* shape, const char* quantity) {
  require(std::isfinite(static_cast<float>(value)), shape, quantity, value, "finite in single precision");
}

// The columns of a surface of revolution: directions from the axis at φ = phimax·i/segments, i = 0 …
// segments. After a full turn the last is the first.
struct Columns {
  std::vector<Point2d> directions;
  double u(double i) const { return i / static_cast<double>(directions.size() - 1); }
  std::uint32_t segments() const { return static_cast<std::uint32_t>(directions.size() - 1); }
};

int share(int of_whole, double part, double whole) {
  return std::max(1, static_cast<int>(std::ceil(of_whole * (part / whole) - 1e-6)));
}

Columns columns(double phimax_rad, int segments_of_turn, const char* shape) {
  require(phimax_rad > 0, shape, "phimax", phimax_rad, "above 0");
  const bool whole = phimax_rad >= 2 * pi * (1 - 1e-7);
  const double phimax = whole ? 2 * pi : phimax_rad;
  const int n = share(segments_of_turn, phimax, 2 * pi);
  Columns result;
  for (int i = 0; i <= n; ++i) result.directions.push_back(unit_circle(phimax * i / n));
  return result;
}

// One circle of latitude: all its points have this distance from the axis, this height and this tilt of the
// normal.
struct Ring {
  double radius, z;
  double normal_across, normal_z;
  float v;
};

// Appends the vertices of a ring: segments + 1, or, on the axis, one for each segment with its middle u.
void append_ring(TriangleMesh& mesh, const Columns& columns, const Ring& ring) {
  const bool on_axis = ring.radius == 0;
  for (std::uint32_t i = 0; i < columns.segments() + (on_axis ? 0 : 1); ++i) {
    const Point2d d = columns.directions[i];
    // Adding zero makes −0 into 0, so that all vertices on the axis have the same bits.
    mesh.positions.push_back({static_cast<float>(ring.radius * d.x + 0.0),
                              static_cast<float>(ring.radius * d.y + 0.0), static_cast<float>(ring.z + 0.0)});
    mesh.normals.push_back({static_cast<float>(ring.normal_across * d.x),
                            static_cast<float>(ring.normal_across * d.y), static_cast<float>(ring.normal_z)});
    mesh.uvs.push_back({static_cast<float>(columns.u(i + (on_axis ? 0.5 : 0.0))), ring.v});
  }
}

// Joins rings in the order of growing v; the front is on the side of ∂p/∂u × ∂p/∂v.
TriangleMesh revolve(const Columns& columns, const std::vector<Ring>& rings) {
  TriangleMesh mesh;
  std::uint32_t lower = 0;
  for (std::size_t j = 0; j < rings.size(); ++j) {
    const auto upper = static_cast<std::uint32_t>(mesh.positions.size());
    append_ring(mesh, columns, rings[j]);
    if (j == 0) continue;
    for (std::uint32_t i = 0; i < columns.segments(); ++i) {
      if (rings[j - 1].radius == 0) {
        mesh.triangles.push_back({lower + i, upper + i + 1, upper + i});
      } else if (rings[j].radius == 0) {
        mesh.triangles.push_back({lower + i, lower + i + 1, upper + i});
      } else {
        mesh.triangles.push_back({lower + i, lower + i + 1, upper + i + 1});
        mesh.triangles.push_back({lower + i, upper + i + 1, upper + i});
      }
    }
    lower = upper;
  }
  return mesh;
}

// The polar angle from −z of a height; rounded to float, so that the last bit of the C library's acos, which
// processors do not agree on, has no part in it. Exact at the poles.
double angle_from_bottom(double z, double radius) {
  if (z <= -radius) return 0;
  if (z >= radius) return pi;
  return static_cast<float>(std::acos(-z / radius));
}

}  // namespace

TriangleMesh tessellate_sphere(double radius, double zmin, double zmax, double phimax_rad) {
  require_size(radius, "sphere", "radius");
  require(!std::isnan(zmin) && !std::isnan(zmax), "sphere", "zmin or zmax", NAN, "a number");
  const double bottom = std::clamp(std::min(zmin, zmax), -radius, radius);
  const double top = std::clamp(std::max(zmin, zmax), -radius, radius);
  require(bottom < top, "sphere", "zmin", zmin, "another height than zmax within the sphere");
  const double first = angle_from_bottom(bottom, radius), last = angle_from_bottom(top, radius);
  const int rows = share(sphere_segments / 2, last - first, pi);
  std::vector<Ring> rings;
  for (int j = 0; j <= rows; ++j) {
    const double angle = j == rows ? last : first + (last - first) * j / rows;
    const Point2d d = unit_circle(angle);  // exactly (±1, 0) at the poles
    const double across = d.y, z = -d.x;
    rings.push_back(
        {radius * across, radius * z, across, z, static_cast<float>(static_cast<double>(j) / rows)});
  }
  return revolve(columns(phimax_rad, sphere_segments, "sphere"), rings);
}

TriangleMesh tessellate_disk(double height, double radius, double inner_radius, double phimax_rad) {
  require_size(radius, "disk", "radius");
  require_finite(height, "disk", "height");
  require(inner_radius >= 0 && inner_radius < radius, "disk", "inner radius", inner_radius,
          "at least 0 and less than the radius");
  return revolve(columns(phimax_rad, disk_segments, "disk"),
                 {{radius, height, 0, 1, 0.f}, {inner_radius, height, 0, 1, 1.f}});
}

TriangleMesh tessellate_cylinder(double radius, double zmin, double zmax, double phimax_rad) {
  require_size(radius, "cylinder", "radius");
  require_finite(zmin, "cylinder", "zmin");
  require_finite(zmax, "cylinder", "zmax");
  require(zmin != zmax, "cylinder", "zmin", zmin, "another height than zmax");
  const double bottom = std::min(zmin, zmax), top = std::max(zmin, zmax);
  return revolve(columns(phimax_rad, cylinder_segments, "cylinder"),
                 {{radius, bottom, 1, 0, 0.f}, {radius, top, 1, 0, 1.f}});
}

TriangleMesh tessellate_cone(double radius, double height, double phimax_rad) {
  require_size(radius, "cone", "radius");
  require_size(height, "cone", "height");
  const double slant = std::hypot(radius, height), across = height / slant, up = radius / slant;
  return revolve(columns(phimax_rad, cylinder_segments, "cone"),
                 {{radius, 0, across, up, 0.f}, {0, height, across, up, 1.f}});
}

TriangleMesh tessellate_paraboloid(double radius, double zmin, double zmax, double phimax_rad) {
  require_size(radius, "paraboloid", "radius");
  const double bottom = std::min(zmin, zmax), top = std::max(zmin, zmax);
  require_size(top, "paraboloid", "zmax");
  require(bottom >= 0 && bottom < top, "paraboloid", "zmin", bottom, "at least 0 and below zmax");
  constexpr int rows = 64;
  const double first = radius * std::sqrt(bottom / top);
  std::vector<Ring> rings;
  for (int j = 0; j <= rows; ++j) {
    const double r = first + (radius - first) * j / rows,
                 z = j == 0 ? bottom : top * (r / radius) * (r / radius);
    const double slope = 2 * top * r / (radius * radius), across = slope / std::hypot(1, slope);  // dz/dr
    rings.push_back(
        {r, z, across, -1 / std::hypot(1, slope), static_cast<float>((z - bottom) / (top - bottom))});
  }
  return revolve(columns(phimax_rad, sphere_segments, "paraboloid"), rings);
}

}  // namespace vitrail
