// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/tessellate.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/geometry/unit_circle.h"
#include "scene/shapes/curve_meshes.h"
#include "scene/shapes/curve_strands.h"
#include "scene/shapes/quadric_places.h"

namespace vitrail {

namespace {

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

Columns columns(const Quadric& q, int segments_of_turn) {
  const double phimax = is_whole_turn(q) ? 2 * pi : q.phi_max_rad;
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
double angle_from_bottom(double z) {
  if (z <= -1) return 0;
  if (z >= 1) return pi;
  return static_cast<float>(std::acos(-z));
}

std::vector<Ring> rings_of_sphere(const Quadric& q, int segments) {
  const double first = angle_from_bottom(q.low), last = angle_from_bottom(q.high);
  const int rows = share(std::max(2, segments / 2), last - first, pi);
  std::vector<Ring> rings;
  for (int j = 0; j <= rows; ++j) {
    const double angle = j == rows ? last : first + (last - first) * j / rows;
    const Point2d d = unit_circle(angle);  // exactly (±1, 0) at the poles
    rings.push_back({d.y, -d.x, d.y, -d.x, static_cast<float>(static_cast<double>(j) / rows)});
  }
  return rings;
}

std::vector<Ring> rings_of_paraboloid(const Quadric& q, int segments) {
  const int rows = std::max(1, segments / 4);
  const double first = std::sqrt(q.low);
  std::vector<Ring> rings;
  for (int j = 0; j <= rows; ++j) {
    const double r = first + (1 - first) * j / rows, z = j == 0 ? q.low : r * r;
    const double slope = 2 * r, slant = std::hypot(1, slope);  // dz/dr
    rings.push_back({r, z, slope / slant, -1 / slant, static_cast<float>((z - q.low) / (1 - q.low))});
  }
  return rings;
}

std::vector<Ring> rings_of(const Quadric& q, int segments) {
  switch (q.kind) {
    case QuadricKind::sphere:
      return rings_of_sphere(q, segments);
    case QuadricKind::cylinder:
      return {{1, 0, 1, 0, 0.f}, {1, 1, 1, 0, 1.f}};
    case QuadricKind::disk:
      return {{1, 0, 0, 1, 0.f}, {q.low, 0, 0, 1, 1.f}};
    case QuadricKind::cone: {
      const double slant = std::sqrt(0.5);
      return {{1, 0, slant, slant, 0.f}, {0, 1, slant, slant, 1.f}};
    }
    case QuadricKind::paraboloid:
      return rings_of_paraboloid(q, segments);
    case QuadricKind::curve:
      break;
  }
  return {};
}

void take_mitsuba_uv(QuadricKind kind, TriangleMesh& mesh) {
  for (Point2f& uv : mesh.uvs)
    if (kind == QuadricKind::sphere)
      uv.y = 1 - uv.y;
    else if (kind == QuadricKind::disk)
      uv = {1 - uv.y, uv.x};
}

TriangleMesh tubes(const Quadric& q, const QuadricPlaces& places, int corners) {
  TriangleMesh mesh;
  for_each_strand(places, [&](std::span<const PlacedCurve> strand) {
    std::vector<CurveSegment> segments;
    double widest = 0;
    for (const PlacedCurve& c : strand) {
      segments.push_back(segment_of(c));
      for (const float r : c.radius) widest = std::max(widest, double{r});
    }
    const bool straight = strand.front().straight;
    CurveDetail detail = curve_detail(places.size(), straight);
    detail.steps = straight ? 1 : steps_within(segments, widest / 6, 2 * detail.steps);
    if (corners > 0) detail.corners = std::max(3, corners);
    append_tube(segments, detail, double{strand.front().along_first}, double{strand.back().along_last},
                straight && strand.front().to[0] == Vector3f{}, mesh);
  });
  if (q.uv == QuadricUv::pbrt)
    for (Point2f& uv : mesh.uvs) uv = {uv.y, uv.x};
  return mesh;
}

}  // namespace

TriangleMesh tessellate(const Quadric& q, int segments) {
  TriangleMesh mesh = revolve(columns(q, std::max(3, segments)), rings_of(q, segments));
  if (q.uv == QuadricUv::mitsuba) take_mitsuba_uv(q.kind, mesh);
  return mesh;
}

TriangleMesh tessellate(const Quadric& q, const QuadricPlaces& places, int segments) {
  if (is_curve(q)) return tubes(q, places, segments);
  const TriangleMesh one = tessellate(q, segments > 0 ? segments : quadric_segments);
  TriangleMesh all;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Transform place;
    places.read(i, {&place, 1});
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    for (const Point3f& p : one.positions)
      all.positions.push_back(cast<float>(transform_point(place, cast<double>(p))));
    for (const Normal3f& n : one.normals)
      all.normals.push_back(cast<float>(transform_normal(place, cast<double>(n))));
    all.uvs.insert(all.uvs.end(), one.uvs.begin(), one.uvs.end());
    for (auto [a, b, c] : one.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

}  // namespace vitrail
