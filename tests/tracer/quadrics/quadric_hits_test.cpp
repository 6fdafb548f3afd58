// SPDX-License-Identifier: Apache-2.0
// Hits of quadrics against the same in 50 digits, and what is found on them against their
// tessellation.
#include "tracer/quadrics/quadric_hits.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <random>

#include "scene/shapes/tessellate.h"
#include "tracer/quadrics/quadric_surface.h"
#include "tracer/rays/ray.h"

namespace vitrail::quadric_hits_test {
namespace {

using Digits =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

constexpr double turn = Quadric{}.phi_max_rad;

Quadric quadric_of(QuadricKind kind) {
  const bool from_zero = kind == QuadricKind::disk || kind == QuadricKind::paraboloid;
  return {.kind = kind, .low = from_zero ? 0.0 : -1.0};
}

std::vector<Quadric> all_quadrics() {
  std::vector<Quadric> all;
  for (const QuadricKind kind : {QuadricKind::sphere, QuadricKind::cylinder, QuadricKind::disk,
                                 QuadricKind::cone, QuadricKind::paraboloid}) {
    all.push_back(quadric_of(kind));
    all.push_back(all.back());
    all.back().low = 0.3;
    all.back().high = kind == QuadricKind::sphere ? 0.8 : 1;
    all.back().phi_max_rad = 4;
  }
  return all;
}

Affine random_transform(std::mt19937& random, int kind, double reach) {
  std::uniform_real_distribution<double> u(-1, 1);
  const double size = std::pow(10, u(random));
  Transform t = translate({reach * u(random), reach * u(random), reach * u(random)}) *
                rotate(3 * u(random), {u(random), u(random), u(random)}) * scale({size, size, size});
  if (kind == 1) t = t * scale({1, 2, -0.3});                         // mirrored
  if (kind == 2) t = t * scale({1e-3, 1e-3, 1});                      // a thread, a needle
  if (kind == 3) t = t * scale({1, 0.05, 1}) * rotate(1, {1, 2, 3});  // sheared
  return affine(t);
}

// The roots of the whole surface, as far as 50 digits tell, with how far each is from where the
// surface ends: < 0 beyond.
struct Root {
  double t, margin;
};
struct Oracle {
  std::vector<Root> roots;
  double discriminant = 0;  // relative: near 0 the ray grazes
};

Oracle oracle(const Ray& ray, const Affine& to_bundle, const Quadric& q) {
  const auto& m = to_bundle.m;
  Digits inverse[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
      inverse[i][j] = Digits(m[r0][c0]) * Digits(m[r1][c1]) - Digits(m[r0][c1]) * Digits(m[r1][c0]);
    }
  const Digits determinant =
      Digits(m[0][0]) * inverse[0][0] + Digits(m[0][1]) * inverse[1][0] + Digits(m[0][2]) * inverse[2][0];
  Digits o[3], d[3];
  for (int i = 0; i < 3; ++i) {
    o[i] = d[i] = 0;
    for (int j = 0; j < 3; ++j) {
      o[i] += inverse[i][j] / determinant * (Digits(ray.origin[j]) - Digits(m[j][3]));
      d[i] += inverse[i][j] / determinant * Digits(ray.direction[j]);
    }
  }
  Digits a = d[0] * d[0] + d[1] * d[1], b = o[0] * d[0] + o[1] * d[1], c = o[0] * o[0] + o[1] * o[1];
  switch (q.kind) {
    case QuadricKind::sphere:
      a += d[2] * d[2], b += o[2] * d[2], c += o[2] * o[2] - 1;
      break;
    case QuadricKind::cylinder:
      c -= 1;
      break;
    case QuadricKind::disk:
      a = 0, b = d[2] / 2, c = o[2];
      break;
    case QuadricKind::cone:
      a -= d[2] * d[2], b += (1 - o[2]) * d[2], c -= (1 - o[2]) * (1 - o[2]);
      break;
    case QuadricKind::paraboloid:
      b -= d[2] / 2, c -= o[2];
      break;
    case QuadricKind::curve:
      break;  // curve_hits_test.cpp
  }
  Oracle result;
  const Digits discriminant = b * b - a * c;
  // In the units of the quadric: how deep the ray goes into it.
  result.discriminant =
      a == 0 ? 1 : static_cast<double>(discriminant / (a * a) * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
  if (discriminant < 0) return result;
  std::vector<Digits> roots;
  if (a == 0) {
    if (b != 0) roots = {-c / (2 * b)};
  } else {
    const Digits root = sqrt(discriminant);
    roots = {(-b - root) / a, (-b + root) / a};
  }
  for (const Digits& t : roots) {
    const Digits x = o[0] + t * d[0], y = o[1] + t * d[1], z = o[2] + t * d[2], rho = sqrt(x * x + y * y);
    Digits margin = t;
    const auto within = [&](const Digits& low, const Digits& value, const Digits& high) {
      margin = std::min(margin, std::min(Digits(value - low), Digits(high - value)));
    };
    if (q.kind == QuadricKind::sphere && q.low > -1) within(q.low, z, q.high);
    if (q.kind == QuadricKind::disk) within(q.low > 0 ? Digits(q.low) : Digits(-1), rho, 1);
    if (q.kind == QuadricKind::paraboloid) within(q.low > 0 ? Digits(q.low) : Digits(-1), z, 1);
    if (q.kind == QuadricKind::cylinder || q.kind == QuadricKind::cone) within(0, z, 1);
    if (q.phi_max_rad < turn) {
      Digits phi = atan2(y, x);
      if (phi < 0) phi += Digits(2) * boost::math::constants::pi<Digits>();
      within(0, phi, q.phi_max_rad);
    }
    result.roots.push_back({static_cast<double>(t), static_cast<double>(margin)});
  }
  std::ranges::sort(result.roots, {}, &Root::t);
  return result;
}

// Rays to points in and about the quadric, from so many of its sizes away; some along its axes.
Ray random_ray(std::mt19937& random, const Affine& to_bundle, double distance) {
  std::uniform_real_distribution<double> u(-1, 1);
  const double reach = random() % 3 == 0 ? 1.0 : 0.9;
  Point3d target{reach * u(random), reach * u(random), reach * u(random)};
  if (random() % 4 == 0) {  // grazing: the edge of the unit sphere
    const Vector3d out = normalize(target - Point3d{});
    target = Point3d{} + out;
  }
  Vector3d way{u(random), u(random), u(random)};
  if (random() % 8 == 0) way = {0, 0, 1};
  const Point3d from = target - way * distance;
  const Point3d origin = placed_point(to_bundle, from), to = placed_point(to_bundle, target);
  return {cast<float>(origin), cast<float>(normalize(to - cast<double>(cast<float>(origin))))};
}

TEST(QuadricHits, AreThoseOfFiftyDigits) {
  std::mt19937 random(1);
  std::uint64_t hits = 0, unsure = 0;
  for (const double distance : {0.3, 3.0, 1e3, 1e6})
    for (const Quadric& q : all_quadrics())
      for (int i = 0; i < 4000; ++i) {
        const Affine to_bundle = random_transform(random, i % 4, i % 2 ? 0 : 10);
        const Ray ray = random_ray(random, to_bundle, distance);
        const Oracle exact = oracle(ray, to_bundle, q);
        // What rounding of the direction and of the origin in the quadric's space can do.
        const double condition = i % 4 == 2 ? 1e4 : 1e2;
        const double error = 1e-14 * condition * std::max(1.0, distance);
        if (std::abs(exact.discriminant) < 100 * error) {
          ++unsure;
          continue;
        }
        const QuadricHits found = quadric_hits(prepare(ray), to_bundle, q, false);
        std::vector<Root> expected;
        bool sure = true;
        for (const Root& root : exact.roots) {
          sure = sure && std::abs(root.margin) > 1e3 * error;
          if (root.margin > 0) expected.push_back(root);
        }
        if (!sure) {
          ++unsure;
          continue;
        }
        ASSERT_EQ(static_cast<std::size_t>(found.count), expected.size())
            << static_cast<int>(q.kind) << " from " << distance << " at " << i;
        for (int k = 0; k < found.count; ++k) {
          ++hits;
          EXPECT_NEAR(found.at[k].t, expected[static_cast<std::size_t>(k)].t,
                      error * std::abs(expected[static_cast<std::size_t>(k)].t) +
                          error / std::sqrt(exact.discriminant));
        }
      }
  EXPECT_GT(hits, 40'000u);
  EXPECT_LT(unsure, 20'000u);
}

// From where a ray meets a quadric, on along it and back: neither finds the point again, and what is left of
// a whole sphere is left on its other side.
TEST(QuadricHits, ARayDoesNotFindWhereItStarts) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-1, 1);
  std::uint64_t others = 0, started = 0, differ = 0;
  for (const Quadric& q : all_quadrics())
    for (int i = 0; i < 4000; ++i) {
      const Affine to_bundle = random_transform(random, i % 4, 10);
      const Ray ray = random_ray(random, to_bundle, 3);
      const QuadricHits first = quadric_hits(prepare(ray), to_bundle, q, false);
      if (first.count == 0) continue;
      const Point3f p = cast<float>(placed_point(to_bundle, first.at[0].local));
      const QuadricHits on = quadric_hits(prepare({p, ray.direction}), to_bundle, q, true);
      // Floats hold the point as far as they do: a ray that grazes may be beside it.
      differ += on.count != first.count - 1;
      ++started;
      if (on.count > 0 && first.count > 1) {
        const double left = first.at[1].t - first.at[0].t;
        const Vector3d off = on.at[0].local - first.at[1].local;
        EXPECT_LT(length(off), 1e-2 * std::max(1.0, 1 / left));
        ++others;
      }
      const Vector3d n = placed_quadric_normal({q, false}, to_bundle, first.at[0].local);
      const Vector3d aside = normalize(n + normalize(Vector3d{u(random), u(random), u(random)}) * 0.99);
      if (is_whole_sphere(q)) {
        EXPECT_EQ(quadric_hits(prepare({p, cast<float>(aside)}), to_bundle, q, true).count, 0);
      }
    }
  EXPECT_GT(others, 3'000u);
  EXPECT_LT(differ * 1000, started);
}

// Normals, sides and (u,v) are those of the triangles.
TEST(QuadricSurface, IsWhatItsTessellationIsOf) {
  std::mt19937 random(3);
  for (Quadric q : all_quadrics())
    for (const QuadricUv uv : {QuadricUv::pbrt, QuadricUv::mitsuba})
      for (int kind = 0; kind < 4; ++kind) {
        q.uv = uv;
        const Affine to_bundle = random_transform(random, kind, 1);
        const bool mirrored = mirrors(to_bundle);
        const TriangleMesh mesh = tessellate(q, 64);
        for (std::size_t i = 0; i < mesh.triangles.size(); i += 37) {
          const auto& t = mesh.triangles[i];
          std::array<Point3d, 3> p;
          for (std::size_t k = 0; k < 3; ++k)
            p[k] = placed_point(to_bundle, cast<double>(mesh.positions[t[k]]));
          const Vector3d front = cross(p[1] - p[0], p[2] - p[0]);
          for (std::size_t k = 0; k < 3; ++k) {
            const Point3d local = cast<double>(mesh.positions[t[k]]);
            // As a shape has it whose transform this is.
            const QuadricPoint at = quadric_point({q, mirrored}, to_bundle, local);
            EXPECT_LT(length(at.p - p[k]), 1e-12);
            if (q.kind == QuadricKind::cone && local.z == 1) continue;  // it has no normal
            EXPECT_GT(dot(at.normal, normalize(front)), kind < 2 ? 0.9 : 0.0) << static_cast<int>(q.kind);
            const Vector3d spanned = normalize(cross(at.dpdu, at.dpdv));
            if (length(spanned) > 0.5) {
              EXPECT_NEAR(std::abs(dot(at.normal, spanned)), 1, 1e-5);
            }
            const double rho = std::hypot(local.x, local.y);
            if (rho < 1e-6) continue;  // u is any
            const Point2f expected = mesh.uvs[t[k]];
            const double du = std::abs(at.uv.x - double{expected.x}),
                         dv = std::abs(at.uv.y - double{expected.y});
            EXPECT_LT(std::min(du, std::abs(1 - du)), 1e-5);
            EXPECT_LT(std::min(dv, std::abs(1 - dv)), 1e-5);
          }
        }
      }
}

// ∂p/∂u and ∂p/∂v are how the point moves with (u,v).
TEST(QuadricSurface, DerivativesAreThoseOfThePoint) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0, 1);
  for (Quadric q : all_quadrics())
    for (const QuadricUv uv : {QuadricUv::pbrt, QuadricUv::mitsuba})
      for (int i = 0; i < 200; ++i) {
        q.uv = uv;
        const Affine to_bundle = random_transform(random, i % 4, 1);
        const double phi = 0.1 + 3 * u(random), v = 0.1 + 0.6 * u(random);
        const auto point = [&](double angle, double along) -> Point3d {
          const double c = std::cos(angle), s = std::sin(angle);
          switch (q.kind) {
            case QuadricKind::sphere: {
              const double first = q.low <= -1 ? 0 : std::acos(-q.low),
                           last = q.high >= 1 ? turn / 2 : std::acos(-q.high);
              const double polar = first + (last - first) * along;
              return {std::sin(polar) * c, std::sin(polar) * s, -std::cos(polar)};
            }
            case QuadricKind::cylinder:
              return {c, s, along};
            case QuadricKind::disk: {
              const double rho = 1 - along * (1 - q.low);
              return {rho * c, rho * s, 0};
            }
            case QuadricKind::cone:
              return {(1 - along) * c, (1 - along) * s, along};
            case QuadricKind::paraboloid: {
              const double z = q.low + along * (1 - q.low);
              return {std::sqrt(z) * c, std::sqrt(z) * s, z};
            }
            case QuadricKind::curve:
              break;
          }
          return {};
        };
        constexpr double h = 1e-5;
        const auto placed = [&](double angle, double along) {
          return placed_point(to_bundle, point(angle, along));
        };
        const Vector3d by_phi = (placed(phi + h, v) - placed(phi - h, v)) * (0.5 / h * q.phi_max_rad);
        const Vector3d by_v = (placed(phi, v + h) - placed(phi, v - h)) * (0.5 / h);
        Vector3d du = by_phi, dv = by_v;
        if (uv == QuadricUv::mitsuba && q.kind == QuadricKind::sphere) dv = -by_v;
        if (uv == QuadricUv::mitsuba && q.kind == QuadricKind::disk) du = -by_v, dv = by_phi;
        const QuadricPoint at = quadric_point({q, false}, to_bundle, point(phi, v));
        EXPECT_LT(length(at.dpdu - du), 1e-6 * (1 + length(du)));
        EXPECT_LT(length(at.dpdv - dv), 1e-6 * (1 + length(dv)));
        // All but (u,v) are the same where these do not show.
        const QuadricPoint plain = quadric_point({q, false}, to_bundle, point(phi, v), false);
        EXPECT_EQ(plain.p, at.p);
        EXPECT_EQ(plain.normal, at.normal);
        EXPECT_EQ(plain.dpdu, at.dpdu);
        EXPECT_EQ(plain.dpdv, at.dpdv);
        EXPECT_EQ(plain.uv, Point2d{});
      }
}

}  // namespace
}  // namespace vitrail::quadric_hits_test
