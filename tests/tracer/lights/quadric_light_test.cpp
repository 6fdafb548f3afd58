// SPDX-License-Identifier: Apache-2.0
// Quadrics that shine: that their densities are those of their samples, and that the mean of the estimator is
// what closed forms and quadratures say.
#include "tracer/lights/quadric_light.h"

#include <gtest/gtest.h>

#include "scene/geometry/portable_math.h"
#include "tests/support/long_tests.h"
#include "tests/tracer/lights/light_fixtures.h"
#include "tracer/quadrics/quadric_hits.h"
#include "tracer/quadrics/quadric_surface.h"
#include "tracer/rays/ray.h"

namespace vitrail::quadric_light_test {

namespace {

using test::Random;

EmissiveQuadric standing(const Quadric& quadric, const Transform& to, bool inside_out = false) {
  EmissiveQuadric e;
  e.quadric = {quadric, inside_out};
  e.to_bundle = affine(to);
  e.triangle = 7;
  return e;
}
EmissiveQuadric ball(Point3d center, double radius, bool inside_out = false) {
  return standing({}, translate(center - Point3d{}) * scale({radius, radius, radius}), inside_out);
}

constexpr QuadricKind kinds[] = {QuadricKind::sphere, QuadricKind::cylinder, QuadricKind::disk,
                                 QuadricKind::cone, QuadricKind::paraboloid};

Quadric whole(QuadricKind kind) {
  Quadric q;
  q.kind = kind;
  if (kind == QuadricKind::disk || kind == QuadricKind::paraboloid) q.low = 0;
  return q;
}
Quadric partial(QuadricKind kind, Random& random) {
  Quadric q = whole(kind);
  q.phi_max_rad = random.between(0.3, 6);
  if (kind == QuadricKind::sphere) q.low = random.between(-0.9, 0.3), q.high = random.between(0.4, 1);
  if (kind == QuadricKind::disk || kind == QuadricKind::paraboloid) q.low = random.between(0, 0.7);
  return q;
}

Transform any_similarity(Random& random) {
  const double size = random.between(0.2, 3);
  return translate(random.point(-2, 2) - Point3d{}) * rotate(random.between(0, 6), random.direction()) *
         scale({size, size, random() < 0.5 ? size : -size});
}
Transform any_affine(Random& random) {
  return any_similarity(random) * scale({random.between(0.2, 2), random.between(0.2, 2), 1}) *
         rotate(random.between(0, 6), random.direction()) * scale({1, 1, random.between(0.2, 2)});
}

// A sampler with that one light, of radiance 1.
struct World {
  std::vector<AreaLight> area_lights;
  std::vector<EmissiveQuadric> quadrics;
  LightSampler sampler;

  explicit World(const EmissiveQuadric& quadric, bool two_sided = false) : quadrics{quadric} {
    AreaLight light{ConstantSpectrum{1}};
    light.two_sided = two_sided;
    area_lights.push_back(light);
    LightScene scene;
    scene.area_lights = area_lights;
    scene.quadrics = quadrics;
    scene.bounds = {{-5, -5, -5}, {5, 5, 5}};
    sampler = make_light_sampler(scene, test::only(nullptr));
  }
  World(const World&) = delete;
};

// Whether nothing of the quadric itself lies between.
bool is_seen(const EmissiveQuadric& e, Point3d p, Vector3d to, double distance) {
  const Ray ray{cast<float>(p), cast<float>(to)};
  const QuadricHits hits = quadric_hits(prepare(ray), e.to_bundle, e.quadric.quadric, false);
  return hits.count == 0 || hits.at[0].t > distance * (1 - 1e-3);
}

struct Estimate {
  double mean = 0, error = 0;
};

Estimate irradiance(const World& world, Point3d p, Vector3d normal, Random& random, int samples = 20000,
                    bool hides_itself = false) {
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i) {
    const auto light = sample_light(world.sampler, p, random.four(), test::some_wavelengths());
    if (!light) continue;
    if (hides_itself && !is_seen(world.quadrics[0], p, light->to_light, light->distance)) continue;
    const double x =
        static_cast<double>(light->radiance[0]) * std::max(0.0, dot(light->to_light, normal)) / light->pdf;
    sum += x / samples;
    squares += x * x / samples;
  }
  return {sum, std::sqrt(std::max(0.0, squares - sum * sum) / samples)};
}

// Sums value(point, cell) · cos θ′/d² dA over cells of the surface as seen from p, by the surface's own
// (u,v): front where cos θ′ > 0. Only what the area light shows.
template <class F>
void over_surface(const EmissiveQuadric& e, bool two_sided, Point3d p, int cells, int fine, F&& add) {
  const Quadric& q = e.quadric.quadric;
  const int n = cells * fine;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double phi = q.phi_max_rad * (i + 0.5) / n, x = (k + 0.5) / n;
      // Heights of spheres go by the angle, so that dA does not blow up at poles.
      double z = 0, rho = 1;
      switch (q.kind) {
        case QuadricKind::sphere: {
          const double a = std::acos(q.low), b = std::acos(q.high), angle = a + (b - a) * x;
          z = std::cos(angle), rho = std::sin(angle);
          break;
        }
        case QuadricKind::cylinder:
          z = x;
          break;
        case QuadricKind::disk:
          rho = q.low + (1 - q.low) * x;
          break;
        case QuadricKind::cone:
          z = x, rho = 1 - x;
          break;
        case QuadricKind::paraboloid:
          rho = std::sqrt(q.low) + (1 - std::sqrt(q.low)) * x, z = rho * rho;
          break;
        case QuadricKind::curve:
          break;
      }
      const QuadricPoint at =
          quadric_point(e.quadric, e.to_bundle, {rho * std::cos(phi), rho * std::sin(phi), z});
      double dv = 1.0 / n;  // of pbrt's v
      if (q.kind == QuadricKind::paraboloid) dv *= 2 * rho * (1 - std::sqrt(q.low)) / (1 - q.low);
      const double area = length(cross(at.dpdu, at.dpdv)) * dv / n;
      const Vector3d way = at.p - p;
      const double d = length(way), cosine = -dot(way, at.normal) / d;
      if (cosine <= 0 && !two_sided) continue;
      add(at.p, way * (1 / d), std::abs(cosine) / (d * d) * area, cosine, i / fine * cells + k / fine);
    }
}

double irradiance_by_quadrature(const EmissiveQuadric& e, bool two_sided, Point3d p, Vector3d normal) {
  double sum = 0;
  over_surface(e, two_sided, p, 1, 400, [&](Point3d at, Vector3d to, double solid_angle, double, int) {
    const double share = std::max(0.0, dot(to, normal)) * solid_angle;
    if (share > 0 && is_seen(e, p, to, length(at - p))) sum += share;
  });
  return sum;
}

// Of a sphere of radiance 1 and radius 1 at distance d > 1, whose centre is seen at `cosine` from the normal;
// also where the horizon cuts it (Lagarde & de Rousiers 2014).
double irradiance_of_ball(double d, double cosine) {
  const double sin2 = 1 / (d * d);
  if (cosine * cosine >= sin2) return pi * sin2 * std::max(0.0, cosine);
  const double sine = std::sqrt(1 - cosine * cosine), x = std::sqrt(d * d - 1), y = -x * cosine / sine;
  const double root = sine * std::sqrt(1 - y * y);
  return (cosine * std::acos(y) - x * root) * sin2 + std::atan(root / x);
}

}  // namespace

TEST(QuadricLight, SpheresLightAsTheirClosedForm) {
  Random random(1);
  for (const double radius : {1e-3, 1.0, 40.0})
    for (const double d : {1.0001, 1.1, 2.0, 30.0, 1e3, 1e6})
      for (const double cosine : {1.0, 0.5, 0.2, 0.01, 0.0, -0.3, -0.9}) {
        const Point3d p{0.3 * radius, -0.2 * radius, 0.1 * radius};
        const Vector3d to = random.direction();
        const Vector3d across = normalize(cross(to, Vector3d{0.3, 1, 0.2}));
        const World world(ball(p + to * (d * radius), radius));
        const double expected = irradiance_of_ball(d, cosine);
        const Estimate got =
            irradiance(world, p, to * cosine + across * std::sqrt(1 - cosine * cosine), random);
        EXPECT_NEAR(got.mean, expected, 4.5 * got.error + 1e-7 * expected)
            << radius << " " << d << " " << cosine;
        // Where all of it is seen chance has only the cosine to work with.
        if (cosine * d >= 1) {
          EXPECT_LT(got.error, 0.01 * expected);
        }
      }
  // The sphere of 10⁻³ at 10³.
  const World world(ball({0, 0, 1e3}, 1e-3));
  const Estimate got = irradiance(world, {0, 0, 0}, {0, 0, 1}, random);
  EXPECT_NEAR(got.mean, pi * 1e-12, 1e-6 * pi * 1e-12);
}

// In a sphere that shines inwards every plane gets π, on its own surface too.
TEST(QuadricLight, SpheresLightWhatIsInThem) {
  Random random(2);
  for (const double off : {0.0, 0.3, 0.99, 1 - 1e-9, 1.0})
    for (const bool two_sided : {false, true}) {
      const Vector3d away = random.direction();
      const World world(ball({100, 200, -300}, 2, !two_sided), two_sided);
      // Where it stands on the sphere, its normal looks in.
      const Vector3d normal = off > 0.5 ? -away : random.direction();
      const Estimate got = irradiance(world, Point3d{100, 200, -300} + away * (2 * off), normal, random);
      EXPECT_NEAR(got.mean, pi, 4.5 * got.error) << off << two_sided;
      EXPECT_LT(got.error, 0.02 * pi);
    }
  // One that shines outwards does not.
  const World world(ball({0, 0, 0}, 2));
  EXPECT_FALSE(sample_light(world.sampler, {0, 0, 1}, random.four(), test::some_wavelengths()));
}

TEST(QuadricLight, DisksLightAsTheirClosedForm) {
  Random random(3);
  for (const double h : {0.3, 2.0, 50.0})
    for (const double a : {0.0, 0.7, 3.0}) {
      // Looking down on a plane that looks up.
      const World world(standing(whole(QuadricKind::disk), translate({0, 0, h}) * rotate(pi, {1, 0, 0})));
      const double s = h * h + a * a;
      const double expected = pi / 2 * (1 - (s - 1) / std::sqrt((s + 1) * (s + 1) - 4 * a * a));
      const Estimate got = irradiance(world, {a, 0, 0}, {0, 0, 1}, random, 40000);
      EXPECT_NEAR(got.mean, expected, 4.5 * got.error) << h << " " << a;
    }
}

// A long tube above a plane that looks at it: π·r/d.
TEST(QuadricLight, TubesLightAsTheirClosedForm) {
  Random random(4);
  for (const double r : {0.01, 0.5})
    for (const double d : {0.6, 3.0}) {
      const World world(standing(whole(QuadricKind::cylinder), translate({0, 0, -1e6}) * scale({r, r, 2e6})));
      const Estimate got = irradiance(world, {d, 0, 0}, {-1, 0, 0}, random);
      EXPECT_NEAR(got.mean, pi * r / d, 4.5 * got.error);
      EXPECT_LT(got.error, 0.01 * got.mean);  // equiangular
    }
}

// What shines inwards lights as the opening that it is seen through, what shines outwards as its base: a disk
// of radius 1 at distance h gives π/(1 + h²) to what faces it on its axis.
TEST(QuadricLight, ConesAndBowlsLightAsTheirOpening) {
  Random random(11);
  const auto disk = [](double h) { return pi / (1 + h * h); };
  struct Case {
    Quadric quadric;
    bool inside_out;
    double z;  // of the point, on the axis
    double expected;
  };
  Quadric bowl;
  bowl.high = 0;
  for (const double h : {0.4, 2.0, 30.0}) {
    const Case cases[] = {{whole(QuadricKind::cone), true, -h, disk(h)},
                          {whole(QuadricKind::cone), false, 1 + h, disk(1 + h)},
                          {whole(QuadricKind::paraboloid), true, 1 + h, disk(h)},
                          {bowl, true, h, disk(h)},
                          {whole(QuadricKind::cylinder), true, -h, disk(h) - disk(1 + h)}};
    for (const Case& c : cases)
      for (const bool two_sided : {false, true}) {
        const World world(standing(c.quadric, {}, c.inside_out), two_sided);
        const Estimate got = irradiance(world, {0, 0, c.z}, {0, 0, c.z < 0 ? 1.0 : -1.0}, random);
        EXPECT_NEAR(got.mean, c.expected, 4.5 * got.error + 1e-7)
            << static_cast<int>(c.quadric.kind) << " " << h << two_sided;
        EXPECT_LT(got.error, 0.02 * c.expected);
      }
  }
}

// No point that shines at another and is not behind the surface itself is without a chance.
TEST(QuadricLight, EveryPointThatIsSeenHasADensity) {
  Random random(12);
  int seen = 0;
  for (int i = 0; i < 400; ++i) {
    const QuadricKind kind = kinds[i % 5];
    const EmissiveQuadric e = standing(i % 2 ? partial(kind, random) : whole(kind),
                                       i % 3 ? any_affine(random) : any_similarity(random), i % 7 == 0);
    const bool two_sided = i % 4 == 0;
    const QuadricLight light(e, two_sided, i % 3 == 1 ? QuadricPatches::fewest : QuadricPatches::most);
    for (int k = 0; k < 200; ++k) {
      const Point3d p = placed_point(e.to_bundle, Point3d{} + random.direction() * random.between(0, 3));
      const Point3d local = point_by_area(e.quadric.quadric, random(), random());
      const Vector3d way = placed_point(e.to_bundle, local) - p;
      const double distance = length(way);
      const double cosine = -dot(way, placed_quadric_normal(e.quadric, e.to_bundle, local)) / distance;
      if (std::abs(cosine) < 1e-4 || (cosine < 0 && !two_sided)) continue;
      if (!is_seen(e, p, way * (1 / distance), distance)) continue;
      ++seen;
      EXPECT_GT(light.pdf(p, placed_point(e.to_bundle, local), cosine), 0) << i << " " << k;
    }
  }
  EXPECT_GT(seen, 20000);
}

TEST(QuadricLight, KnowsWhereItsPointsAreByArea) {
  Random random(13);
  for (int i = 0; i < 500; ++i) {
    const Quadric q = i % 2 ? partial(kinds[i % 5], random) : whole(kinds[i % 5]);
    const double s = random(), t = random.between(0.001, 1);
    const Point2d at = place_by_area(q, point_by_area(q, s, t));
    EXPECT_NEAR(at.x, s, 1e-12);
    EXPECT_NEAR(at.y, t, 1e-12);
  }
}

TEST(QuadricLight, AllLightAsTheirQuadrature) {
  Random random(5);
  for (const QuadricKind kind : kinds)
    for (int i = 0; i < 8; ++i) {
      const EmissiveQuadric e = standing(i % 2 ? partial(kind, random) : whole(kind),
                                         i % 3 ? any_affine(random) : any_similarity(random), i % 4 == 3);
      const bool two_sided = i % 4 > 1;
      const World world(e, two_sided);
      const Point3d p = placed_point(e.to_bundle, Point3d{} + random.direction() * random.between(1.6, 6));
      const Vector3d normal = random.direction();
      const double expected = irradiance_by_quadrature(e, two_sided, p, normal);
      const Estimate got = irradiance(world, p, normal, random, 20000, true);
      EXPECT_NEAR(got.mean, expected, 4.5 * got.error + 2e-3 * expected)
          << static_cast<int>(kind) << " " << i;
    }
}

TEST(QuadricLight, DensitiesAreThoseOfTheSamples) {
  Random random(6);
  int found = 0;
  for (int i = 0; i < 3000; ++i) {
    const QuadricKind kind = kinds[i % 5];
    const EmissiveQuadric e = standing(i % 2 ? partial(kind, random) : whole(kind),
                                       i % 3 ? any_affine(random) : any_similarity(random), i % 7 == 0);
    const World world(e, i % 4 == 0);
    const double far = i % 8 == 0 ? 1e6 : i % 8 == 1 ? 1 + 1e-6 : random.between(0, 5);
    const Point3d p = placed_point(e.to_bundle, Point3d{} + random.direction() * far);
    const auto light = sample_light(world.sampler, p, random.four(), test::some_wavelengths());
    if (!light) continue;
    ++found;
    EXPECT_NEAR(length(light->to_light), 1, 1e-12);
    EXPECT_EQ(light->quadric, &world.quadrics[0]);
    const Point3d at = p + light->to_light * light->distance;
    const double cosine = -dot(light->to_light, light->normal);
    if (std::abs(cosine) < 1e-4) continue;  // its rounding counts
    EXPECT_NEAR(triangle_pdf(world.sampler, p, 7, at, light->distance, cosine) / light->pdf, 1, 1e-6)
        << i << " " << far;
    EXPECT_EQ(triangle_pdf(world.sampler, p, 8, at, light->distance, cosine), 0);
  }
  EXPECT_GT(found, 1500);
}

// χ² of where samples lie, in cells of the surface, against the integral of the density over each: so it
// integrates to 1, or to what share of the samples shows something.
TEST(QuadricLight, SamplesFollowTheirDensity) {
  Random random(7);
  constexpr int cells = 8;
  const int samples = test::of_all(20000, 10000);
  for (const QuadricKind kind : kinds)
    for (int i = 0; i < 10; ++i) {
      const EmissiveQuadric e = standing(i % 2 ? partial(kind, random) : whole(kind),
                                         i % 3 ? any_affine(random) : any_similarity(random), i % 5 == 4);
      const bool two_sided = i % 4 > 1;
      // Patches about as large as the cells, so that few points of the quadrature stand for each.
      const QuadricLight light(e, two_sided, 64);
      const bool inside = i > 7;
      const Point3d p =
          placed_point(e.to_bundle, Point3d{} + random.direction() * (inside ? 0.6 : random.between(1.5, 8)));
      std::array<double, cells * cells + 1> expected{};
      double all = 0;
      over_surface(e, two_sided, p, cells, 60,
                   [&](Point3d at, Vector3d, double solid_angle, double cosine, int cell) {
                     const double share = light.pdf(p, at, cosine) * solid_angle;
                     expected[static_cast<std::size_t>(cell)] += share;
                     all += share;
                   });
      EXPECT_LT(all, 1 + 3e-3);
      expected.back() = std::max(0.0, 1 - all);
      std::array<int, cells * cells + 1> seen{};
      for (int k = 0; k < samples; ++k) {
        const auto s = light.sample(p, static_cast<float>(random()), static_cast<float>(random()));
        if (!s) {
          ++seen.back();
          continue;
        }
        EXPECT_NEAR(length((p + s->to_light * s->distance) - placed_point(e.to_bundle, s->local)), 0, 1e-9);
        const Point2d uv = quadric_point(e.quadric, e.to_bundle, s->local).uv;
        double v = e.quadric.quadric.kind == QuadricKind::disk ? 1 - uv.y : uv.y;
        if (kind == QuadricKind::paraboloid) {
          const double low = std::sqrt(e.quadric.quadric.low);
          v = (std::sqrt(s->local.z) - low) / (1 - low);
        }
        const int cell = std::min(static_cast<int>(uv.x * cells), cells - 1) * cells +
                         std::clamp(static_cast<int>(v * cells), 0, cells - 1);
        ++seen[static_cast<std::size_t>(cell)];
      }
      double chi2 = 0;
      int freedom = -1;
      double rest_expected = 0, rest_seen = 0;
      for (std::size_t k = 0; k < expected.size(); ++k) {
        if (expected[k] * samples < 10) {
          rest_expected += expected[k] * samples, rest_seen += seen[k];
          continue;
        }
        const double off = seen[k] - expected[k] * samples;
        chi2 += off * off / (expected[k] * samples);
        ++freedom;
      }
      EXPECT_LT(chi2, freedom + 5 * std::sqrt(2.0 * freedom) + 5) << static_cast<int>(kind) << " " << i;
      EXPECT_NEAR(rest_seen, rest_expected, 5 * std::sqrt(rest_expected + 4) + 3e-3 * samples);
    }
}

// The tree never takes a light for dark that is not.
TEST(QuadricLight, BoundsHoldItsPointsAndNormals) {
  Random random(8);
  for (int i = 0; i < 500; ++i) {
    const QuadricKind kind = kinds[i % 5];
    const EmissiveQuadric e = standing(i % 2 ? partial(kind, random) : whole(kind),
                                       i % 3 ? any_affine(random) : any_similarity(random), i % 7 == 0);
    const QuadricLight light(e, false);
    const LightBounds b = light.bounds();
    for (int k = 0; k < 50; ++k) {
      const Point3d local = point_by_area(e.quadric.quadric, random(), random());
      const Point3d at = placed_point(e.to_bundle, local);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(at[axis], b.box.lower[axis] - 1e-9);
        EXPECT_LE(at[axis], b.box.upper[axis] + 1e-9);
      }
      const Vector3d normal = placed_quadric_normal(e.quadric, e.to_bundle, local);
      EXPECT_LE(std::acos(std::clamp(dot(normal, b.axis), -1.0, 1.0)), b.theta_o_rad + 1e-6) << i;
    }
  }
  EXPECT_EQ(QuadricLight(standing(whole(QuadricKind::disk), {}), false).bounds().theta_o_rad, 0);
}

TEST(QuadricLight, KnowsItsArea) {
  Random random(9);
  EXPECT_NEAR(QuadricLight(ball({1, 2, 3}, 2), false).area(), 16 * pi, 1e-9);
  const auto area = [](QuadricKind kind, Vector3d size) {
    return QuadricLight(standing(whole(kind), scale(size)), false).area();
  };
  EXPECT_NEAR(area(QuadricKind::disk, {2, 3, 1}), 6 * pi, 1e-9);
  EXPECT_NEAR(area(QuadricKind::cylinder, {2, 2, 5}), 20 * pi, 1e-9);
  EXPECT_NEAR(area(QuadricKind::cone, {3, 3, 4}), 15 * pi, 1e-9);
  EXPECT_NEAR(area(QuadricKind::paraboloid, {1, 1, 1}), (5 * std::sqrt(5.0) - 1) / 6 * pi, 1e-9);
  // A spheroid (Beyer 1987).
  const double eccentricity = std::sqrt(1 - 0.25);
  EXPECT_NEAR(area(QuadricKind::sphere, {1, 1, 2}), 2 * pi * (1 + 2 / eccentricity * std::asin(eccentricity)),
              0.05);
}

TEST(QuadricLight, ShinesThoughNothingMeetsIt) {
  EmissiveQuadric e = ball({0, 0, 3}, 1);
  for (const float opacity : {0.0f, 0.5f}) {
    e.opacity = opacity;
    const World world(e);
    const auto light =
        sample_light(world.sampler, {0, 0, 0}, {0.5f, 0.5f, 0.5f, 0.5f}, test::some_wavelengths());
    ASSERT_TRUE(light);
    EXPECT_EQ(light->is_delta, opacity == 0);
    EXPECT_EQ(light->radiance[0], opacity == 0 ? 1 : opacity);
  }
}

// No numbers that are none.
TEST(QuadricLight, FlattenedOnesGiveNothing) {
  Random random(10);
  for (const QuadricKind kind : kinds) {
    const World world(standing(whole(kind), scale({1, 0, 0})), true);
    EXPECT_FALSE(sample_light(world.sampler, {1, 2, 3}, random.four(), test::some_wavelengths()));
    EXPECT_EQ(triangle_pdf(world.sampler, {1, 2, 3}, 7, {0, 0, 0}, 1, 1), 0);
  }
}

}  // namespace vitrail::quadric_light_test
