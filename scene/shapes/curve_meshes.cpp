// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/curve_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/geometry/frame.h"
#include "scene/geometry/pi.h"
#include "scene/geometry/unit_circle.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// A point of the curve: what a ring or the two edges of a ribbon are made of.
struct Sample {
  Point3d center;
  Vector3d tangent;
  double radius = 0;
  double slope = 0;  // of the radius along the curve
  double along = 0;  // in segments
};

Sample sample(const CurveSegment& s, double t) {
  const CurvePoint a = mix(mix(s[0], s[1], t), mix(s[1], s[2], t), t),
                   b = mix(mix(s[1], s[2], t), mix(s[2], s[3], t), t);
  const CurvePoint p = mix(a, b, t);
  Vector3d derivative = (b.position - a.position) * 3.0;
  // The ends of curves whose control points coincide there.
  if (!(length(derivative) > 0)) derivative = s[3].position - s[0].position;
  const double speed = length(derivative), change = 3 * (b.radius - a.radius);
  return {p.position, normalize(derivative), p.radius, speed > 0 ? change / speed : 0, t};
}

// Joints take the mean of both sides; where a curve turns back, the tangent of what comes.
void join(Sample& last, const Sample& next) {
  const Vector3d sum = last.tangent + next.tangent;
  last.tangent = length(sum) > 1e-6 ? normalize(sum) : next.tangent;
  last.slope = (last.slope + next.slope) / 2;
}

// Of points on top of each other one would have no tangent: they are left out.
std::vector<Sample> samples_of(std::span<const CurveSegment> segments, int steps) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (int k = 0; k <= steps; ++k) {
      Sample next = sample(segments[i], static_cast<double>(k) / steps);
      if (!(length(next.tangent) > 0)) continue;
      next.along += static_cast<double>(i);
      if (k == 0 && !samples.empty())
        join(samples.back(), next);
      else
        samples.push_back(next);
    }
  }
  return samples;
}

// The second and the negated first axis of the frame: Mitsuba counts angles from them.
struct Axes {
  Vector3d first, second;
};

Axes axes_around(Vector3d n) {
  const Frame frame(n);
  return {frame.bitangent, -frame.tangent};
}

// The axes carried along the curve without twist.
Axes carried(const Axes& axes, Vector3d tangent) {
  const Vector3d across = axes.first - tangent * dot(axes.first, tangent);
  if (!(length(across) > 1e-6)) return axes_around(tangent);
  const Vector3d first = normalize(across);
  return {first, cross(tangent, first)};
}

struct Ring {
  Point3d center;
  Axes axes;
  Vector3d tangent;
  double radius, normal_across, normal_along;
  float v;
};

// Half a sphere's rings from its pole inwards; they stand before the first ring or, reversed, after the last.
std::vector<Ring> round_end(const Ring& end, double outwards) {
  constexpr int rings = 4;
  std::vector<Ring> result;
  for (int k = 0; k < rings; ++k) {
    const Point2d d = unit_circle(pi / 2 * k / rings);  // (cos, sin) of the angle from the pole
    Ring ring = end;
    ring.center = end.center + end.tangent * (outwards * end.radius * d.x);
    ring.radius = end.radius * d.y;
    ring.normal_across = d.y;
    ring.normal_along = outwards * d.x;
    result.push_back(ring);
  }
  return result;
}

std::vector<Ring> rings_of(const std::vector<Sample>& samples, double v_first, double v_per_segment,
                           bool round_ends) {
  std::vector<Ring> rings;
  Axes axes = axes_around(samples.front().tangent);
  for (const Sample& s : samples) {
    axes = carried(axes, s.tangent);
    const double length_of_normal = std::sqrt(1 + s.slope * s.slope);
    rings.push_back({s.center, axes, s.tangent, s.radius, 1 / length_of_normal, -s.slope / length_of_normal,
                     static_cast<float>(v_first + s.along * v_per_segment)});
  }
  if (!round_ends) return rings;
  std::vector<Ring> first = round_end(rings.front(), -1), last = round_end(rings.back(), 1);
  rings.insert(rings.begin(), first.begin(), first.end());
  rings.insert(rings.end(), last.rbegin(), last.rend());
  return rings;
}

void require_room(const TriangleMesh& mesh, std::size_t more) {
  if (mesh.positions.size() + more > std::numeric_limits<std::uint32_t>::max())
    throw Error("curves: more vertices than 32 bits count");
}

// The ring's polygon has the circumference of its circle. So it is as wide as that, in the mean of all sides
// that it is seen from (Cauchy 1841).
void append_ring(const Ring& ring, int corners, TriangleMesh& mesh) {
  const double to_corner = ring.radius * (pi / corners) / unit_circle(pi / corners).y;
  for (int i = 0; i <= corners; ++i) {
    const Point2d d = unit_circle(2 * pi * (i % corners) / corners);
    const Vector3d across = ring.axes.first * d.x + ring.axes.second * d.y;
    const Point3f p = cast<float>(ring.center + across * to_corner);
    if (!is_finite(p)) throw Error("curves: a point is not finite in single precision");
    mesh.positions.push_back(p);
    mesh.normals.push_back(
        cast<float>(to_normal(across * ring.normal_across + ring.tangent * ring.normal_along)));
    mesh.uvs.push_back({static_cast<float>(i) / static_cast<float>(corners), ring.v});
  }
}

// A triangle with an edge around a ring without radius is none.
void join_rings(std::uint32_t lower, int corners, bool lower_is_point, bool upper_is_point,
                TriangleMesh& mesh) {
  const auto row = static_cast<std::uint32_t>(corners) + 1, upper = lower + row;
  for (std::uint32_t i = 0; i + 1 < row; ++i) {
    if (!lower_is_point) mesh.triangles.push_back({lower + i, lower + i + 1, upper + i + 1});
    if (!upper_is_point) mesh.triangles.push_back({lower + i, upper + i + 1, upper + i});
  }
}

}  // namespace

KeptCurves::KeptCurves(QuadricUv uv, std::uint64_t memory_bytes) {
  mesh.quadric = Quadric{.kind = QuadricKind::curve, .uv = uv};
  mesh.places = places = std::make_shared<QuadricPlaces>(*mesh.quadric, memory_bytes);
}

void KeptCurves::add(std::span<const PlacedCurve> curves) {
  for (const PlacedCurve& curve : curves) {
    if (!is_valid(curve)) throw Error("curves: a point is not finite in single precision");
    places->add(packed(curve));
  }
}

CurveDetail curve_detail(std::size_t segments, bool straight) {
  constexpr std::size_t few = 1u << 12, many = 1u << 18, most = 1u << 25;
  if (segments > most)
    throw Error(fmt::format("{} segments of curves are more than the {} that triangles can stand for",
                            segments, most));
  const CurveDetail detail = segments <= few    ? CurveDetail{8, 16}
                             : segments <= many ? CurveDetail{4, 8}
                                                : CurveDetail{2, 4};
  return {straight ? 1 : detail.steps, detail.corners};
}

void append_tube(std::span<const CurveSegment> segments, const CurveDetail& detail, double v_first,
                 double v_last, bool round_ends, TriangleMesh& mesh) {
  const std::vector<Sample> samples = samples_of(segments, detail.steps);
  if (samples.size() < 2) return;
  const std::vector<Ring> rings =
      rings_of(samples, v_first, (v_last - v_first) / static_cast<double>(segments.size()), round_ends);
  const auto row = static_cast<std::size_t>(detail.corners) + 1;
  require_room(mesh, rings.size() * row);
  for (std::size_t j = 0; j < rings.size(); ++j) {
    append_ring(rings[j], detail.corners, mesh);
    if (j > 0)
      join_rings(static_cast<std::uint32_t>(mesh.positions.size() - 2 * row), detail.corners,
                 rings[j - 1].radius == 0, rings[j].radius == 0, mesh);
  }
}

int steps_within(std::span<const CurveSegment> segments, double tolerance, int most) {
  double bend = 0;  // the greatest second difference
  for (const CurveSegment& s : segments)
    for (std::size_t i = 0; i < 2; ++i)
      bend = std::max(bend,
                      length((s[i + 2].position - s[i + 1].position) - (s[i + 1].position - s[i].position)));
  const double steps = std::sqrt(0.75 * bend / tolerance);
  return steps < most ? std::max(1, static_cast<int>(std::ceil(steps))) : most;
}

namespace {

// Of opposite ones, which have no shortest way, what the formula tends to: it ends between them at 0.
Vector3d interpolate_on_sphere(Vector3d a, Vector3d b, double t) {
  const double angle = std::atan2(length(cross(a, b)), dot(a, b)), sine = std::sin(angle);
  if (!(sine > 1e-6)) return dot(a, b) > 0 ? normalize(a * (1 - t) + b * t) : a * std::cos(pi * t);
  return a * (std::sin((1 - t) * angle) / sine) + b * (std::sin(t * angle) / sine);
}

}  // namespace

void append_ribbon(std::span<const CurveSegment> segments, std::span<const Vector3d> normals, int steps,
                   TriangleMesh& mesh) {
  const std::vector<Sample> samples = samples_of(segments, steps);
  if (samples.size() < 2) return;
  require_room(mesh, 2 * samples.size());
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Sample& s : samples) {
    const auto segment = std::min(static_cast<std::size_t>(s.along), segments.size() - 1);
    const Vector3d normal = interpolate_on_sphere(
        normalize(normals[segment]), normalize(normals[segment + 1]), s.along - static_cast<double>(segment));
    const Vector3d across = cross(normal, s.tangent), facing = cross(s.tangent, across);
    const auto u = static_cast<float>(s.along / static_cast<double>(segments.size()));
    for (const double side : {-1.0, 1.0}) {
      const Point3f p = cast<float>(s.center + across * (side * s.radius));
      if (!is_finite(p)) throw Error("curves: a point is not finite in single precision");
      mesh.positions.push_back(p);
      mesh.normals.push_back(
          cast<float>(to_normal(length(facing) > 0 ? normalize(facing) : Frame(s.tangent).tangent)));
      mesh.uvs.push_back({u, side < 0 ? 0.f : 1.f});
    }
  }
  for (std::uint32_t j = 0; j + 1 < samples.size(); ++j) {
    const std::uint32_t a = first + 2 * j;
    mesh.triangles.push_back({a, a + 2, a + 3});
    mesh.triangles.push_back({a, a + 3, a + 1});
  }
}

}  // namespace vitrail
