// SPDX-License-Identifier: Apache-2.0
// Hits of curves against what bisection finds in extended precision of the same balls, and what is found
// there.
#include "tracer/quadrics/curve_hits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tracer/quadrics/curve_parts.h"

namespace vitrail::curve_hits_test {
namespace {

using Real = long double;

struct RealBall {
  Real x, y, z, r;
};

// The balls between which the parts of a curve are, from the curve's origin.
std::vector<RealBall> balls_of(const PlacedCurve& c) {
  const CurveSegment s = segment_of(c);
  const int parts = 1 << halvings(c, greatest_radius(c));
  std::vector<RealBall> balls;
  for (int i = 0; i <= parts; ++i) {
    const Real t = static_cast<Real>(i) / parts, u = 1 - t;
    const Real w[4] = {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
    RealBall b{};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d p = s[k].position - c.origin;
      b.x += w[k] * Real{p.x}, b.y += w[k] * Real{p.y}, b.z += w[k] * Real{p.z},
          b.r += w[k] * Real{s[k].radius};
    }
    balls.push_back(b);
  }
  return balls;
}

// Of a convex function of [low, high].
Real least_of(const auto& f, Real low, Real high, Real& where) {
  for (int i = 0; i < 60; ++i) {
    const Real a = low + (high - low) * 0.45L, b = low + (high - low) * 0.55L;
    if (f(a) < f(b))
      high = b;
    else
      low = a;
  }
  where = (low + high) / 2;
  return f(where);
}

struct RealRay {
  Vector3d o, d;
};

// How far the point of the ray is out of the hull of two balls: by the ball between them that it is the least
// out of, which is where that does not change.
Real outside(const RealRay& ray, Real t, const RealBall& a, const RealBall& b) {
  const Real x = Real{ray.o.x} + t * Real{ray.d.x}, y = Real{ray.o.y} + t * Real{ray.d.y},
             z = Real{ray.o.z} + t * Real{ray.d.z};
  const auto out_of = [&](Real s) {
    const Real u = 1 - s;
    return std::hypot(x - a.x * u - b.x * s, y - a.y * u - b.y * s, z - a.z * u - b.z * s) -
           (a.r * u + b.r * s);
  };
  const Real size = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z), slope = (b.r - a.r) / size;
  if (!(std::abs(slope) < 1)) return std::min(out_of(0), out_of(1));
  const Real along = ((x - a.x) * (b.x - a.x) + (y - a.y) * (b.y - a.y) + (z - a.z) * (b.z - a.z)) / size;
  const Real foot = along / size;
  const Real away =
      std::hypot(x - a.x - foot * (b.x - a.x), y - a.y - foot * (b.y - a.y), z - a.z - foot * (b.z - a.z));
  return out_of(std::clamp((along + away * slope / std::sqrt(1 - slope * slope)) / size, Real{0}, Real{1}));
}

struct RealInterval {
  Real begin, end, depth;
  bool at_surface = true;
};

Real root_of(const auto& f, Real inside, Real out) {
  for (int i = 0; i < 70; ++i) {
    const Real middle = (inside + out) / 2;
    (f(middle) <= 0 ? inside : out) = middle;
  }
  return (inside + out) / 2;
}

// All that the line has of the curve, merged; `depth`: how deep it goes into the shallowest part.
std::vector<RealInterval> oracle(const RealRay& ray, const PlacedCurve& c, Real& shallowest) {
  const std::vector<RealBall> balls = balls_of(c);
  const Vector3d first = first_plane(c), last = last_plane(c), end = cast<double>(c.to[2]);
  std::vector<RealInterval> found;
  const Real near = -Real{dot(ray.o, ray.d)} / Real{dot(ray.d, ray.d)};
  const Real reach = (Real{length(end)} * 20 + 20 * Real{greatest_radius(c)}) / Real{length(ray.d)};
  shallowest = INFINITY;
  for (std::size_t i = 0; i + 1 < balls.size(); ++i) {
    const auto f = [&](Real t) { return outside(ray, t, balls[i], balls[i + 1]); };
    Real deepest;
    const Real depth = least_of(f, near - reach, near + reach, deepest);
    shallowest = std::min(shallowest, std::abs(depth));
    if (depth > 0) continue;
    RealInterval v{root_of(f, deepest, near - reach), root_of(f, deepest, near + reach), -depth};
    const auto cut = [&](Vector3d n, Vector3d at, bool keeps_beyond) {
      const Real along = Real{dot(ray.d, n)}, plane = (Real{dot(at, n)} - Real{dot(ray.o, n)}) / along;
      if (n == Vector3d{} || along == 0) return;
      if ((along > 0) == keeps_beyond) {
        if (plane > v.begin) v.begin = plane, v.at_surface = false;
      } else {
        v.end = std::min(v.end, plane);
      }
    };
    if (i == 0) cut(first, {}, true);
    if (i + 2 == balls.size()) cut(last, end, false);
    if (v.begin <= v.end) found.push_back(v);
  }
  std::ranges::sort(found, {}, &RealInterval::begin);
  std::vector<RealInterval> merged;
  for (const RealInterval& v : found) {
    if (!merged.empty() && v.begin <= merged.back().end)
      merged.back().end = std::max(merged.back().end, v.end);
    else
      merged.push_back(v);
  }
  return merged;
}

Vector3d random_vector(std::mt19937& random) {
  std::normal_distribution<double> g;
  return {g(random), g(random), g(random)};
}

// Bent or straight, of equal and unequal radii, with round and with flat ends.
PlacedCurve random_curve(std::mt19937& random, int kind) {
  std::uniform_real_distribution<double> u(0, 1);
  CurveSegment s;
  const double radius = std::pow(10, -2 * u(random)) / 5;
  Point3d p{3, -2, 1};
  const Vector3d way = random_vector(random);
  for (CurvePoint& point : s) {
    point = {p, kind % 2 ? radius : radius * u(random)};
    p = kind % 5 ? p + way + random_vector(random) * 0.6 : Point3d{3, -2, 1} + random_vector(random);
  }
  const bool straight = kind % 3 == 0;
  return placed_curves(std::vector{s}, 0.25, 0.5, straight, kind % 4 == 0)[0];
}

// Towards a place on the curve, more or less off it; from nearby, or from 10⁶ radii away.
RealRay random_ray(std::mt19937& random, const PlacedCurve& c, int kind) {
  std::uniform_real_distribution<double> u(0, 1);
  const std::vector<RealBall> balls = balls_of(c);
  const RealBall& b = balls[random() % balls.size()];
  Vector3d d = normalize(random_vector(random));
  if (kind % 5 == 0) d = normalize(cast<double>(c.to[2]));  // along it
  Vector3d side = cross(d, random_vector(random));
  side = normalize(side) * greatest_radius(c) * (kind % 3 == 0 ? 1 - 1e-6 * u(random) : 1.2 * u(random));
  const Vector3d to =
      Vector3d{static_cast<double>(b.x), static_cast<double>(b.y), static_cast<double>(b.z)} + side;
  const double away = kind % 7 == 0 ? 1e6 * greatest_radius(c) : 4 * u(random);
  return {to - d * away, d * (kind % 2 ? 1 : 3.7)};
}

TEST(Curves, HitsAreThoseOfTheirBalls) {
  std::mt19937 random(1);
  int hits = 0, differ = 0;
  for (int i = 0; i < 1500; ++i) {
    const PlacedCurve c = random_curve(random, i);
    const RealRay ray = random_ray(random, c, static_cast<int>(random() % 210));
    Real shallowest;
    const auto intervals = oracle(ray, c, shallowest);
    if (shallowest < 1e-7L * Real{greatest_radius(c)}) continue;  // it grazes: both answers are right
    const auto first = std::ranges::find_if(intervals, [](const RealInterval& v) { return v.begin > 0; });
    const auto next =
        std::ranges::find_if(first, intervals.end(), [](const RealInterval& v) { return v.at_surface; });
    const QuadricHits found = curve_hits(ray.o, ray.d, c, false);
    const bool there = next != intervals.end();
    if ((found.count > 0) != there) {
      ++differ;
      continue;
    }
    if (!there) continue;
    ++hits;
    const double expected = static_cast<double>(next->begin);
    EXPECT_NEAR(found.at[0].t, expected, 1e-8 * greatest_radius(c) + 1e-12 * expected) << i;
  }
  EXPECT_GT(hits, 500);
  EXPECT_EQ(differ, 0);
}

// What leaves a curve does not meet it where it starts; what goes into it comes out without a hit.
TEST(Curves, ARayThatStartsThereMeetsOnlyWhatLiesBeyond) {
  std::mt19937 random(2);
  int started = 0, beyond = 0, differ = 0;
  for (int i = 0; i < 1500; ++i) {
    const PlacedCurve c = random_curve(random, i);
    RealRay ray = random_ray(random, c, static_cast<int>(random() % 210));
    const QuadricHits hit = curve_hits(ray.o, ray.d, c, false);
    if (hit.count == 0) continue;
    const QuadricPoint point = curve_point(c, hit.at[0].local, false, false);
    ray = {cast<double>(cast<float>(point.p)) - c.origin, random_vector(random)};
    if (std::abs(dot(ray.d, point.normal)) < 0.05 * length(ray.d)) continue;
    Real shallowest;
    const auto intervals = oracle(ray, c, shallowest);
    if (shallowest < 1e-5L * Real{greatest_radius(c)}) continue;
    ++started;
    const Real close = 2e-3L *  // where it starts is rounded to floats
                       Real{greatest_radius(c)};
    const auto next = std::ranges::find_if(intervals, [&](const RealInterval& v) {
      return v.begin * Real{length(ray.d)} > close && v.at_surface;
    });
    const QuadricHits found = curve_hits(ray.o, ray.d, c, true);
    beyond += found.count;
    differ += (found.count > 0) != (next != intervals.end());
  }
  EXPECT_GT(started, 400);
  EXPECT_GT(beyond, 2);
  EXPECT_EQ(differ, 0);
}

TEST(Curves, WhatIsThereIsOnTheTube) {
  std::mt19937 random(3);
  int checked = 0;
  for (int i = 0; i < 1000; ++i) {
    const PlacedCurve c = random_curve(random, i);
    const RealRay ray = random_ray(random, c, static_cast<int>(random() % 210));
    const QuadricHits hit = curve_hits(ray.o, ray.d, c, false);
    if (hit.count == 0) continue;
    ++checked;
    const double r = greatest_radius(c), away = std::max(1.0, length(ray.o));
    const QuadricPoint at = curve_point(c, hit.at[0].local, false, false);
    EXPECT_LT(length(at.p - c.origin - (hit.at[0].local - Point3d{})), 1e-9 * r + 1e-15 * away) << i;
    EXPECT_NEAR(length(at.normal), 1, 1e-12);
    EXPECT_NEAR(length(at.shading), 1, 1e-12);
    EXPECT_LT(dot(at.normal, ray.d), 1e-4 * length(ray.d)) << i;
    EXPECT_TRUE(at.uv.x >= 0.25 && at.uv.x <= 0.5 && at.uv.y >= 0 && at.uv.y <= 1);
    // Out of the curve along the normal.
    const auto balls = balls_of(c);
    const auto outside_by = [&](Vector3d p) {
      Real least = INFINITY;
      for (std::size_t k = 0; k + 1 < balls.size(); ++k)
        least = std::min(least, outside({p, {}}, 0, balls[k], balls[k + 1]));
      return static_cast<double>(least);
    };
    const double step = 1e-3 * r;
    if (outside_by(at.p - c.origin) < -1e-9 * away) continue;  // in what an end's plane cut off
    EXPECT_NEAR(outside_by(at.p - c.origin + at.normal * step), step, 1e-3 * step + 1e-12 * away) << i;
    // v goes around: right-handed with the normal and u.
    EXPECT_GT(dot(cross(at.dpdu, at.shading), at.dpdv), 0) << i;
    const QuadricPoint other = curve_point(c, hit.at[0].local, true, true);
    EXPECT_EQ(other.uv, (Point2d{at.uv.y, at.uv.x}));
    EXPECT_EQ(other.normal, -at.normal);
  }
  EXPECT_GT(checked, 400);
}

// Out of one leg of a hairpin into the other, which is nearer than the leg is thick.
TEST(Curves, WhatLeavesALegMeetsTheOther) {
  CurveSegment s;
  const Point3d points[4] = {{0, 0, 0}, {4, 0, 0}, {4, .12, 0}, {0, .12, 0}};
  for (std::size_t k = 0; k < 4; ++k) s[k] = {points[k], .05};
  const PlacedCurve c = placed_curve(s, 0, 1, false);
  for (double x = .5; x < 1.5; x += .01) {
    const QuadricHits back = curve_hits({x, .06, 0}, {0, -1, 0}, c, false);
    ASSERT_EQ(back.count, 1) << x;
    const QuadricHits found = curve_hits({x, .06 - back.at[0].t, 0}, {0, 1, 0}, c, true);
    ASSERT_EQ(found.count, 1) << x;
    EXPECT_LT(found.at[0].t, .03);
  }
}

TEST(Curves, NormalsOfATaperLeanToItsPoint) {
  CurveSegment s;
  for (std::size_t k = 0; k < 4; ++k) {
    const double x = static_cast<double>(k);
    s[k] = {{x, 0, 0}, .3 - x / 10};
  }
  const PlacedCurve c = placed_curve(s, 0, 1, false);
  const QuadricHits hit = curve_hits({1.3, 0, 5}, {0, 0, -1}, c, false);
  ASSERT_EQ(hit.count, 1);
  const QuadricPoint at = curve_point(c, hit.at[0].local, false, false);
  EXPECT_NEAR(at.shading.x, .1 / std::sqrt(1.01), 1e-6);  // of circles across
  EXPECT_NEAR(at.normal.x, .1, 1e-6);                     // of balls
}

TEST(Curves, NothingOfACurveWithoutWidthOrLengthBreaks) {
  const Vector3d z{0, 0, 1};
  PlacedCurve c;  // one point
  EXPECT_EQ(curve_hits({0, 0, -1}, z, c, false).count, 0);
  c.radius.fill(0.5f);
  c.straight = true;  // a ball
  const QuadricHits ball = curve_hits({0, 0.3, -2}, z, c, false);
  ASSERT_EQ(ball.count, 1);
  EXPECT_DOUBLE_EQ(ball.at[0].t, 1.6);
  EXPECT_NEAR(curve_point(c, ball.at[0].local, false, false).normal.z, -0.8, 1e-12);
  c.to[2] = {1, 0, 0};
  c.radius.fill(0);
  EXPECT_EQ(curve_hits({0.5, 0, -1}, z, c, false).count, 0);
  c.straight = false;
  c.radius = {0.f, 0.1f, 0.1f, 0.f};
  c.to = {};  // all in one place, of a radius that is nowhere
  EXPECT_LE(curve_hits({0, 0, -1}, z, c, true).count, 1);
}

TEST(Curves, APlaceIsTheirRecord) {
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const PlacedCurve c = random_curve(random, i);
    const Transform place = packed(c);
    for (const auto& row : place.m)
      for (const double x : row) EXPECT_TRUE(std::isfinite(x));
    const PlacedCurve again = unpacked_curve(place);
    EXPECT_EQ(again.origin, c.origin);
    EXPECT_EQ(again.to, c.to);
    EXPECT_EQ(again.radius, c.radius);
    EXPECT_EQ(std::pair(again.along_first, again.along_last), std::pair(c.along_first, c.along_last));
    EXPECT_EQ(again.straight, c.straight);
    const Transform t = rotate(1, {1, 2, 3}) * scale({2, 2, -2});
    EXPECT_TRUE(is_similarity(t));
    const PlacedCurve there = transformed(t, c);
    EXPECT_FLOAT_EQ(there.radius[1], 2 * c.radius[1]);
    EXPECT_TRUE(there.mirrored);
  }
  EXPECT_FALSE(is_similarity(scale({1, 1, 1.01})));
}

}  // namespace
}  // namespace vitrail::curve_hits_test
