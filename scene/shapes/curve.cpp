// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/curve.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace vitrail {

namespace {

// Degree 2 written as degree 3.
CurveSegment elevated(const CurvePoint& a, const CurvePoint& b, const CurvePoint& c) {
  return {a, mix(a, b, 2.0 / 3), mix(c, b, 2.0 / 3), c};
}

double packed(float low, float high) {
  return std::bit_cast<double>(std::uint64_t{std::bit_cast<std::uint32_t>(high)} << 32 |
                               std::bit_cast<std::uint32_t>(low));
}

// The first 18 floats of a place: three a half row.
using Halves = std::array<float, 18>;
constexpr std::uint32_t straight_bit = 1, mirrored_bit = 2;

PlacedCurve unpacked(const Point3d& origin, const Halves& h) {
  PlacedCurve c;
  c.origin = origin;
  for (std::size_t i = 0; i < 3; ++i) c.to[i] = {h[3 * i], h[3 * i + 1], h[3 * i + 2]};
  std::copy_n(&h[9], 4, c.radius.begin());
  c.along_first = h[13];
  c.along_last = h[14];
  const auto flags = std::bit_cast<std::uint32_t>(h[16]);
  c.straight = (flags & straight_bit) != 0;
  c.mirrored = (flags & mirrored_bit) != 0;
  return c;
}

void read_row(const auto& row, std::size_t i, double& origin, Halves& h) {
  for (std::size_t j = 0; j < 3; ++j) {
    const auto bits = std::bit_cast<std::uint64_t>(row[j]);
    h[6 * i + 2 * j] = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    h[6 * i + 2 * j + 1] = std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32));
  }
  origin = row[3];
}

Vector3d plane_between(Vector3d before, Vector3d after) {
  const double a = length(before), b = length(after);
  const Vector3d sum = (a > 0 ? before * (1 / a) : Vector3d{}) + (b > 0 ? after * (1 / b) : Vector3d{});
  return length(sum) > 1e-3 ? sum : Vector3d{};  // a curve that turns back has no such plane
}

}  // namespace

std::vector<CurveSegment> linear_segments(std::span<const CurvePoint> p) {
  std::vector<CurveSegment> result;
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    result.push_back({p[i], mix(p[i], p[i + 1], 1.0 / 3), mix(p[i], p[i + 1], 2.0 / 3), p[i + 1]});
  return result;
}

std::vector<CurveSegment> bspline_segments(std::span<const CurvePoint> p) {
  std::vector<CurveSegment> result;
  for (std::size_t i = 0; i + 3 < p.size(); ++i) {
    const CurvePoint b = mix(p[i + 1], p[i + 2], 1.0 / 3), c = mix(p[i + 1], p[i + 2], 2.0 / 3);
    const CurvePoint before = mix(p[i], p[i + 1], 2.0 / 3), after = mix(p[i + 2], p[i + 3], 1.0 / 3);
    result.push_back({mix(before, b, 0.5), b, c, mix(c, after, 0.5)});
  }
  return result;
}

std::vector<CurveSegment> quadratic_bspline_segments(std::span<const CurvePoint> p) {
  std::vector<CurveSegment> result;
  for (std::size_t i = 0; i + 2 < p.size(); ++i)
    result.push_back(elevated(mix(p[i], p[i + 1], 0.5), p[i + 1], mix(p[i + 1], p[i + 2], 0.5)));
  return result;
}

std::vector<CurveSegment> bezier_segments(std::span<const CurvePoint> p) {
  std::vector<CurveSegment> result;
  for (std::size_t i = 0; i + 3 < p.size(); i += 3) result.push_back({p[i], p[i + 1], p[i + 2], p[i + 3]});
  return result;
}

std::vector<CurveSegment> quadratic_bezier_segments(std::span<const CurvePoint> p) {
  std::vector<CurveSegment> result;
  for (std::size_t i = 0; i + 2 < p.size(); i += 2) result.push_back(elevated(p[i], p[i + 1], p[i + 2]));
  return result;
}

PlacedCurve placed_curve(const CurveSegment& s, double along_first, double along_last, bool straight) {
  PlacedCurve c;
  c.origin = s[0].position;
  for (std::size_t i = 0; i < 3; ++i) c.to[i] = cast<float>(s[i + 1].position - s[0].position);
  for (std::size_t i = 0; i < 4; ++i) c.radius[i] = static_cast<float>(s[i].radius);
  c.along_first = static_cast<float>(along_first);
  c.along_last = static_cast<float>(along_last);
  c.straight = straight;
  return c;
}

std::vector<PlacedCurve> placed_curves(std::span<const CurveSegment> segments, double along_first,
                                       double along_last, bool straight, bool round_ends) {
  std::vector<PlacedCurve> curves;
  const double n = static_cast<double>(segments.size());
  const auto chord = [&](std::size_t i) { return segments[i][3].position - segments[i][0].position; };
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto along = [&](std::size_t k) {
      return along_first + (along_last - along_first) * static_cast<double>(k) / n;
    };
    CurveSegment s = segments[i];
    if (straight) {
      const Vector3d end = round_ends ? Vector3d{} : chord(i);
      s[1].position = s[0].position + (i > 0 ? plane_between(chord(i - 1), chord(i)) : end);
      s[2].position = s[3].position - (i + 1 < segments.size() ? plane_between(chord(i), chord(i + 1)) : end);
    }
    curves.push_back(placed_curve(s, along(i), along(i + 1), straight));
  }
  return curves;
}

Transform packed(const PlacedCurve& c) {
  Halves h{};
  for (std::size_t i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis) h[3 * i + static_cast<std::size_t>(axis)] = c.to[i][axis];
  std::copy_n(c.radius.begin(), 4, &h[9]);
  h[13] = c.along_first;
  h[14] = c.along_last;
  h[16] = std::bit_cast<float>((c.straight ? straight_bit : 0) | (c.mirrored ? mirrored_bit : 0));
  Transform t;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t.m[i][j] = packed(h[6 * i + 2 * j], h[6 * i + 2 * j + 1]);
  t.m[0][3] = c.origin.x;
  t.m[1][3] = c.origin.y;
  t.m[2][3] = c.origin.z;
  return t;
}

PlacedCurve unpacked_curve(const double (&rows)[3][4]) {
  Halves h;
  double origin[3];
  for (std::size_t i = 0; i < 3; ++i) read_row(rows[i], i, origin[i], h);
  return unpacked({origin[0], origin[1], origin[2]}, h);
}

PlacedCurve unpacked_curve(const Transform& packed) {
  Halves h;
  double origin[3];
  for (std::size_t i = 0; i < 3; ++i) read_row(packed.m[i], i, origin[i], h);
  return unpacked({origin[0], origin[1], origin[2]}, h);
}

bool is_valid(const PlacedCurve& c) {
  return is_finite(c.origin) &&
         std::ranges::all_of(c.to, [](Vector3f v) { return is_finite(Point3f{} + v); }) &&
         std::ranges::all_of(c.radius, [](float r) { return r >= 0 && std::isfinite(r); }) &&
         std::isfinite(c.along_first) && std::isfinite(c.along_last);
}

PlacedCurve transformed(const Transform& t, const PlacedCurve& c) {
  const auto& m = t.m;
  PlacedCurve out = c;
  // As compose() of matrices: term by term, so that a chain of them has one result.
  const auto row = [&](std::size_t i, Vector3d v) { return m[i][0] * v.x + m[i][1] * v.y + m[i][2] * v.z; };
  const auto linear = [&](Vector3d v) { return Vector3d{row(0, v), row(1, v), row(2, v)}; };
  out.origin = Point3d{m[0][3], m[1][3], m[2][3]} + linear(c.origin - Point3d{});
  for (Vector3f& v : out.to) v = cast<float>(linear(cast<double>(v)));
  double squares = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) squares += m[i][j] * m[i][j];
  const double scale = std::sqrt(squares / 3);
  for (float& r : out.radius) r = static_cast<float>(double{r} * scale);
  out.mirrored = c.mirrored != swaps_handedness(t);
  return out;
}

bool is_similarity(const Transform& t) {
  constexpr double tolerance = 1e-4;
  const auto column = [&](std::size_t j) { return Vector3d{t.m[0][j], t.m[1][j], t.m[2][j]}; };
  const Vector3d x = column(0), y = column(1), z = column(2);
  const double mean = (dot(x, x) + dot(y, y) + dot(z, z)) / 3, off = tolerance * mean;
  return std::abs(dot(x, x) - mean) <= 2 * off && std::abs(dot(y, y) - mean) <= 2 * off &&
         std::abs(dot(z, z) - mean) <= 2 * off && std::abs(dot(x, y)) <= off && std::abs(dot(y, z)) <= off &&
         std::abs(dot(z, x)) <= off;
}

Bounds3d bounds_of(const PlacedCurve& c) {
  const double r = double{*std::ranges::max_element(c.radius)};
  Bounds3d box;
  const auto add = [&](Point3d p) {
    extend(box, p - Vector3d{r, r, r});
    extend(box, p + Vector3d{r, r, r});
  };
  add(c.origin);
  for (std::size_t i = c.straight ? 2 : 0; i < 3; ++i) add(c.origin + cast<double>(c.to[i]));
  return box;
}

CurveSegment segment_of(const PlacedCurve& c) {
  CurveSegment s;
  for (std::size_t i = 0; i < 4; ++i)
    s[i] = {i == 0 ? c.origin : c.origin + cast<double>(c.to[i - 1]), double{c.radius[i]}};
  if (c.straight) {
    s[1].position = s[0].position + (s[3].position - s[0].position) * (1.0 / 3);
    s[2].position = s[0].position + (s[3].position - s[0].position) * (2.0 / 3);
  }
  return s;
}

}  // namespace vitrail
