// SPDX-License-Identifier: Apache-2.0
// Unbiasedness: the mean of radiance·cos⁺/pdf is the irradiance that the light's own formula gives.
#include "tracer/lights/light_sampler.h"

#include <gtest/gtest.h>

#include <limits>

#include "scene/geometry/portable_math.h"
#include "tests/tracer/lights/light_fixtures.h"

namespace vitrail::light_sampler_test {

namespace {

using test::Random;

struct World {
  std::vector<AreaLight> area_lights;
  std::vector<EmissiveTriangle> triangles;
  std::vector<Light> lights;

  LightScene scene() const {
    LightScene s;
    s.area_lights = area_lights;
    s.triangles = triangles;
    s.lights = lights;
    s.bounds = {{-5, -5, -5}, {5, 5, 5}};
    return s;
  }
  void add_area_light(float radiance, bool two_sided, bool directional = false) {
    AreaLight light;
    light.radiance = Spectrum{ConstantSpectrum{radiance}};
    light.two_sided = two_sided;
    light.directional = directional;
    area_lights.push_back(light);
  }
  void add_triangle(Point3d a, Point3d b, Point3d c, std::uint32_t id, std::uint32_t light) {
    triangles.push_back({{cast<float>(a), cast<float>(b), cast<float>(c)}, {}, id, light});
  }
  void add(LightModel model) { lights.push_back({std::move(model), {}}); }
};

LightSampler make(const World& world, std::shared_ptr<const LightImage> image = nullptr,
                  LightChoice choice = LightChoice::tree) {
  return make_light_sampler(world.scene(), test::only(std::move(image)), choice);
}

struct Estimate {
  double mean = 0, error = 0;  // standard error
  double variance = 0;
};

// The irradiance of a plane with that normal.
Estimate estimate(const LightSampler& s, Point3d p, Vector3d normal, int samples, Random& random) {
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i) {
    const auto light = sample_light(s, p, random.four(), test::some_wavelengths());
    if (!light) continue;
    EXPECT_GT(light->pdf, 0);
    EXPECT_NEAR(length(light->to_light), 1, 1e-9);
    const double x =
        static_cast<double>(light->radiance[0]) * std::max(0.0, dot(light->to_light, normal)) / light->pdf;
    sum += x / samples;
    squares += x * x / samples;
  }
  const double variance = std::max(0.0, squares - sum * sum);
  return {sum, std::sqrt(variance / samples), variance};
}

// Σ over n² cells of the triangles.
double irradiance_of_triangles(const World& world, Point3d p, Vector3d normal) {
  constexpr int n = 200;
  double sum = 0;
  for (const EmissiveTriangle& t : world.triangles) {
    const AreaLight& light = world.area_lights[t.area_light];
    const double radiance =
        static_cast<double>(std::get<ConstantSpectrum>(std::get<Spectrum>(light.radiance)).value);
    const Point3d p0 = cast<double>(t.p[0]);
    const Vector3d e1 = cast<double>(t.p[1]) - p0, e2 = cast<double>(t.p[2]) - p0, across = cross(e1, e2);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n - i; ++k)
        for (int half = 0; half < (k < n - i - 1 ? 2 : 1); ++half) {
          const double b1 = (i + (half ? 2 : 1) / 3.0) / n, b2 = (k + (half ? 2 : 1) / 3.0) / n;
          const Vector3d d = (p0 + e1 * b1 + e2 * b2) - p;
          const double d2 = dot(d, d), facing = -dot(d, across) / 2 / (n * n);
          if (facing < 0 && !light.two_sided) continue;
          sum += radiance * std::abs(facing) * std::max(0.0, dot(d, normal)) / (d2 * d2);
        }
  }
  return sum;
}

World triangle_world(Random& random, int count) {
  World world;
  world.add_area_light(3, false);
  world.add_area_light(1, true);
  world.add_area_light(20, false);
  for (int i = 0; i < count; ++i) {
    const Point3d a = random.point(-2, 2);
    world.add_triangle(a, a + random.direction(), a + random.direction(),
                       100 + 3 * static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i % 3));
  }
  return world;
}

}  // namespace

TEST(LightSampler, TrianglesAreUnbiased) {
  Random random(1);
  for (const int count : {1, 2, 7, 60}) {
    const World world = triangle_world(random, count);
    for (const LightChoice choice : {LightChoice::tree, LightChoice::power}) {
      const LightSampler s = make(world, nullptr, choice);
      for (int i = 0; i < 3; ++i) {
        const Point3d p = random.point(3, 6);
        const Vector3d normal = normalize(Vector3d{-1, -1, -0.5});
        const double expected = irradiance_of_triangles(world, p, normal);
        const Estimate got = estimate(s, p, normal, 40000, random);
        EXPECT_NEAR(got.mean, expected, 4.5 * got.error + 1e-3 * expected) << count << " " << i;
      }
    }
  }
}

TEST(LightSampler, PdfOfATriangleIsThatOfItsSamples) {
  Random random(2);
  World world = triangle_world(random, 60);
  world.add(DistantLight{{0, 0, 1}, ConstantSpectrum{1}});
  const LightSampler s = make(world);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point3d p = random.point(-4, 4);
    const auto light = sample_light(s, p, random.four(), test::some_wavelengths());
    if (!light || light->is_delta) continue;
    ASSERT_EQ(light->light.kind, LightKind::triangle);
    const EmissiveTriangle& t = world.triangles[light->light.index];
    const Point3d p0 = cast<double>(t.p[0]);
    const Vector3d n = normalize(cross(cast<double>(t.p[1]) - p0, cast<double>(t.p[2]) - p0));
    EXPECT_NEAR(dot((p + light->to_light * light->distance) - p0, n), 0, 1e-9);
    const double pdf = triangle_pdf(s, p, t.triangle, {}, light->distance, -dot(light->to_light, n));
    EXPECT_NEAR(pdf, light->pdf, 1e-9 * light->pdf);
    ++found;
  }
  EXPECT_GT(found, 500);
  EXPECT_EQ(triangle_pdf(s, {0, 0, 0}, 99, {}, 1, 1), 0);
  EXPECT_EQ(triangle_pdf(s, {0, 0, 0}, 101, {}, 1, 1), 0);  // between two ids
  EXPECT_EQ(triangle_pdf(s, {0, 0, 0}, 5000, {}, 1, 1), 0);
  EXPECT_EQ(triangle_pdf(s, {3, 3, 3}, 100, {}, 1, -0.5), 0);  // its back
}

// Σ over triangles of ∫ pdf over the triangle, as seen from p, is the share of what can be reached.
// What one candidate leaves behind changes nothing of the next.
TEST(LightSampler, GivesEachOfSeveralCandidatesAsAlone) {
  Random random(11);
  World world = triangle_world(random, 200);
  world.add(DistantLight{{0, 0, 1}, ConstantSpectrum{1}});
  const LightSampler s = make(world);
  const SampledWavelengths wavelengths = test::some_wavelengths();
  int found = 0;
  for (int i = 0; i < 50; ++i) {
    const Point3d p = random.point(-4, 4);
    const std::array<float, 2> far{0.25f, 0.75f};
    LastLamp last;
    LightChooser chooser(s, p, far, wavelengths, last);
    for (int k = 0; k < 40; ++k) {
      const std::array<float, 4> u = random.four();
      LastLamp none;
      const auto alone = sample_light(s, p, u, far, wavelengths, none), candidate = chooser.sample(u);
      ASSERT_EQ(alone.has_value(), candidate.has_value());
      if (!alone) continue;
      ++found;
      ASSERT_EQ(alone->light, candidate->light);
      ASSERT_EQ(alone->to_light, candidate->to_light);
      ASSERT_EQ(alone->distance, candidate->distance);
      ASSERT_EQ(alone->pdf, candidate->pdf);
      ASSERT_EQ(alone->radiance.v, candidate->radiance.v);
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(LightSampler, PdfsOfAllTrianglesIntegrateToOne) {
  Random random(3);
  World world = triangle_world(random, 40);
  for (AreaLight& light : world.area_lights) light.two_sided = true;
  const LightSampler s = make(world);
  for (int i = 0; i < 20; ++i) {
    const Point3d p = random.point(-8, 8);
    double sum = 0;
    for (const EmissiveTriangle& t : world.triangles) {
      const Point3d p0 = cast<double>(t.p[0]);
      const double area = length(cross(cast<double>(t.p[1]) - p0, cast<double>(t.p[2]) - p0)) / 2;
      // pdf per area at distance 1 and cosine 1 is the probability of the triangle over its area.
      sum += triangle_pdf(s, p, t.triangle, {}, 1, 1) * area;
    }
    EXPECT_NEAR(sum, 1, 1e-4);
  }
}

TEST(LightSampler, PointLikeLightsAreExact) {
  World world;
  world.add(PointLight{{0, 0, 2}, ConstantSpectrum{3}});
  const LightSampler s = make(world);
  const auto light = sample_light(s, {0, 0, 0}, {0.1f, 0.2f, 0.3f, 0.4f}, test::some_wavelengths());
  ASSERT_TRUE(light);
  EXPECT_TRUE(light->is_delta);
  EXPECT_EQ(light->pdf, 1);
  EXPECT_EQ(light->distance, 2);
  EXPECT_EQ(light->to_light, (Vector3d{0, 0, 1}));
  EXPECT_EQ(light->radiance[0], 0.75f);
  EXPECT_FALSE(sample_light(s, {0, 0, 2}, {0.1f, 0.2f, 0.3f, 0.4f}, test::some_wavelengths()));
}

// Every kind at once.
TEST(LightSampler, AllKindsTogetherAreUnbiased) {
  Random random(4);
  World world = triangle_world(random, 20);
  world.add(PointLight{{1, 0, 2}, ConstantSpectrum{3}});
  SpotLight spot;
  spot.light_to_world = look_at({0, 0, 4}, {4, 4, 3}, {0, 0, 1});
  spot.intensity = ConstantSpectrum{40};
  world.add(spot);
  world.add(DistantLight{normalize(Vector3d{1, 1, 0.2}), ConstantSpectrum{0.7f}});
  world.add(DistantLight{normalize(Vector3d{1, 0, 0}), ConstantSpectrum{0.1f}});
  world.add(InfiniteLight{ConstantSpectrum{0.5f}});
  EnvironmentLight sky;
  sky.scale = ConstantSpectrum{0.1f};
  sky.light_to_world = rotate(2, {1, 0, 3});
  world.add(sky);
  std::vector<double> texels;
  for (int i = 0; i < 64; ++i) texels.push_back(i == 20 ? 30 : i % 3);
  const LightSampler s = make(world, std::make_shared<test::GreyImage>(8, 8, texels));
  const Vector3d normal = normalize(Vector3d{-1, -1, -0.5});
  const SampledWavelengths w = test::some_wavelengths();
  for (int i = 0; i < 3; ++i) {
    const Point3d p = random.point(3, 5);
    double expected = irradiance_of_triangles(world, p, normal);
    const auto add_point = [&](const PointEmitter& e) {
      const Vector3d d = e.position - p;
      const double along = length(d);
      expected += static_cast<double>(intensity(e, d * (-1 / along), nullptr, w)[0]) / dot(d, d) *
                  std::max(0.0, dot(d, normal)) / along;
    };
    add_point(make_emitter(std::get<PointLight>(world.lights[0].model)));
    add_point(make_emitter(spot));
    expected += 0.7 * dot(normalize(Vector3d{-1, -1, -0.2}), normal) + 0.1 * dot(Vector3d{-1, 0, 0}, normal);
    // The constant light comes along where the image is sampled, which is everywhere.
    constexpr int n = 600;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Vector3d d = sphere_direction(SphereProjection::equal_area, {(x + 0.5) / n, (y + 0.5) / n});
        expected += static_cast<double>(background(s, d, w).radiance[0]) * std::max(0.0, dot(d, normal)) * 4 *
                    pi / (n * n);
      }
    const Estimate got = estimate(s, p, normal, 200000, random);
    EXPECT_NEAR(got.mean, expected, 4.5 * got.error + 2e-3 * expected);
    EXPECT_LT(got.error, 0.02 * expected);
  }
  double shares = 0;
  for (const double share : s.share) shares += share;
  EXPECT_NEAR(shares, 1, 1e-12);
}

TEST(LightSampler, EnvironmentPdfIsThatOfItsSamples) {
  World world;
  for (int i = 0; i < 2; ++i) {
    EnvironmentLight sky;
    sky.light_to_world = rotate(1.0 + i, {1, 2.0 * i, 3});
    sky.projection =
        i == 0 ? EnvironmentLight::Projection::equal_area : EnvironmentLight::Projection::latitude_longitude;
    world.add(sky);
  }
  Random random(5);
  const LightSampler s =
      make(world, std::make_shared<test::GreyImage>(
                      4, 4, std::vector<double>{1, 2, 3, 4, 0, 0, 9, 8, 7, 1, 2, 5, 3, 3, 1, 1}));
  double inverse = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto light = sample_light(s, {1, 2, 3}, random.four(), test::some_wavelengths());
    ASSERT_TRUE(light);
    const Background seen = background(s, light->to_light, test::some_wavelengths());
    EXPECT_EQ(light->pdf, seen.pdf);
    EXPECT_EQ(light->radiance, seen.radiance);
    EXPECT_TRUE(std::isinf(light->distance));
    inverse += 1 / light->pdf / 20000;
  }
  EXPECT_NEAR(inverse, 4 * pi, 0.1 * pi);
}

TEST(LightSampler, ConstantSkiesAreLeftToTheBsdf) {
  World world;
  world.add(InfiniteLight{ConstantSpectrum{2}});
  const LightSampler s = make(world);
  EXPECT_FALSE(s.can_sample());
  EXPECT_FALSE(sample_light(s, {0, 0, 0}, {}, test::some_wavelengths()));
  const Background seen = background(s, {0, 0, 1}, test::some_wavelengths());
  EXPECT_EQ(seen.pdf, 0);
  EXPECT_EQ(seen.radiance[3], 2);
}

// A square that shines only along its normal lights the prism before it, evenly.
TEST(LightSampler, DirectionalSurfacesLightWhatLiesBeforeThem) {
  World world;
  world.add_area_light(5, false, true);
  world.add_triangle({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, 0, 0);
  world.add_triangle({0, 0, 0}, {2, 2, 0}, {0, 2, 0}, 1, 0);
  const LightSampler s = make(world);
  Random random(6);
  const Estimate inside = estimate(s, {0.5, 1.2, 3}, {0, 0, -1}, 20000, random);
  EXPECT_NEAR(inside.mean, 5, 4 * inside.error);
  EXPECT_EQ(estimate(s, {2.1, 1.2, 3}, {0, 0, -1}, 100, random).mean, 0);
  EXPECT_EQ(estimate(s, {0.5, 1.2, -3}, {0, 0, 1}, 100, random).mean, 0);
  EXPECT_TRUE(is_black(emitted(s, 0, {}, 1, test::some_wavelengths())));
  EXPECT_EQ(triangle_pdf(s, {0.5, 1.2, 3}, 0, {}, 3, 1), 0);
}

TEST(LightSampler, EmitsOnItsFrontOrBothSides) {
  World world;
  world.add_area_light(5, false);
  world.add_area_light(6, true);
  world.area_lights[1].scale = 0.5f;
  const LightSampler s = make(world);
  EXPECT_EQ(emitted(s, 0, {}, 0.3, test::some_wavelengths())[0], 5);
  EXPECT_EQ(emitted(s, 0, {}, -0.3, test::some_wavelengths())[0], 0);
  EXPECT_EQ(emitted(s, 1, {}, -0.3, test::some_wavelengths())[0], 3);
}

TEST(LightSampler, KnowsDistantLightsByTheirNumbers) {
  World world;
  const Vector3d along = normalize(Vector3d{1, 2, -3});
  world.add_area_light(5, false);
  world.add(InfiniteLight{ConstantSpectrum{1}});
  world.add(DistantLight{along, ConstantSpectrum{1}});
  world.add(DistantLight{-along, ConstantSpectrum{1}});
  const LightSampler s = make(world);
  const auto is = [&](Vector3d wanted) { return [=](Vector3d to_light) { return to_light == wanted; }; };
  EXPECT_FALSE(any_distant_light(s, 0, 0xfff, {}, is(-along)));
  EXPECT_TRUE(any_distant_light(s, 1, 0xfff, {}, is(-along)));
  EXPECT_FALSE(any_distant_light(s, 1, 0xfff, {}, is(along)));
  EXPECT_TRUE(any_distant_light(s, 2, 0xfff, {}, is(along)));
}

// The mask leaves several lights with the same bits.
TEST(LightSampler, KnowsManyDistantLightsByTheLastBitsOfTheirNumbers) {
  World world;
  for (int i = 0; i < 40; ++i)
    world.add(DistantLight{normalize(Vector3d{double(i) - 20, 5, -30}), ConstantSpectrum{1}});
  const LightSampler s = make(world);
  for (std::uint32_t bits = 0; bits < 8; ++bits) {
    std::vector<Vector3d> asked;
    any_distant_light(s, bits, 7, {}, [&](Vector3d to_light) { return asked.push_back(to_light), false; });
    ASSERT_EQ(asked.size(), 5u);
    for (std::size_t i = 0; i < asked.size(); ++i) EXPECT_EQ(asked[i], -s.distant[bits + 8 * i].direction);
  }
}

// Of many single lights each comes as often as its share says, the last one and those without light, too.
TEST(LightSampler, ChoosesAmongManyDistantLightsByTheirShares) {
  World world;
  constexpr int count = 300;
  for (int i = 0; i < count; ++i)
    world.add(
        DistantLight{normalize(Vector3d{double(i), 5, -300}), ConstantSpectrum{i % 5 == 0 ? 0 : float(i)}});
  const LightSampler s = make(world);
  ASSERT_EQ(s.share.size(), 1 + s.distant.size());
  EXPECT_EQ(s.distant.size(), std::size_t{count} * 4 / 5);
  std::vector<int> chosen(s.share.size());
  constexpr int tries = 1 << 20;
  for (int i = 0; i < tries; ++i) ++chosen[s.choice_of((i + 0.5) / tries)];
  for (std::size_t i = 0; i < chosen.size(); ++i) EXPECT_NEAR(chosen[i], s.share[i] * tries, 2) << i;
}

// Many of them have little of their own: the size of a record is that of a point light, whatever kinds there
// are.
TEST(LightSampler, PointLightsShareWhatTheyHaveAlike) {
  static_assert(sizeof(Light) <= 168 && sizeof(PointEmitter) <= 72);
  World world;
  for (int i = 0; i < 100; ++i) world.add(PointLight{{double(i), 0, 2}, ConstantSpectrum{3}});
  const LightSampler s = make(world);
  ASSERT_EQ(s.emitters.size(), 100u);
  for (const PointEmitter& e : s.emitters) EXPECT_EQ(e.shape, s.emitters[0].shape);
  EXPECT_TRUE(s.slots.empty());
  std::vector<bool> found(100);
  for (std::size_t slot = 0; slot < 100; ++slot) found[s.light_of(slot).index] = true;
  EXPECT_EQ(std::ranges::count(found, true), 100);
}

// Nothing that a scene can hold makes a number that is not one.
TEST(LightSampler, DegenerateLightsGiveNothing) {
  World world;
  world.add_area_light(5, true);
  world.add_area_light(0, true);
  world.add_triangle({1, 1, 1}, {1, 1, 1}, {2, 2, 2}, 0, 0);
  world.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
  world.add(DistantLight{{0, 0, 0}, ConstantSpectrum{1}});
  world.add(PointLight{{0, 0, 0}, ConstantSpectrum{0}});
  const LightSampler s = make(world);
  EXPECT_FALSE(s.can_sample());
  EXPECT_FALSE(sample_light(s, {0, 0, 0}, {}, test::some_wavelengths()));
  EXPECT_EQ(triangle_pdf(s, {0, 0, 1}, 0, {}, 1, 1), 0);
}

// A lamp of two triangles differs little from afar; a light without extent never does. Among several lamps
// the tree chooses.
TEST(LightSampler, SaysHowMuchSamplesDiffer) {
  World lamp;
  lamp.add_area_light(1, false);
  lamp.add_triangle({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, 0, 0);
  lamp.add_triangle({0, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 0);
  const LightSampler one = make(lamp);
  EXPECT_EQ(variety(one, {0.5, 0.5, 1}), Variety::much);
  EXPECT_EQ(variety(one, {0.5, 0.5, 4}), Variety::little);
  World more = lamp;
  more.add(InfiniteLight{ConstantSpectrum{1}});  // never sampled
  EXPECT_EQ(variety(make(more), {0.5, 0.5, 4}), Variety::little);
  more.add(PointLight{{0, 0, 1}, ConstantSpectrum{1}});
  EXPECT_EQ(variety(make(more), {0.5, 0.5, 1}), Variety::little);
  World points;
  points.add(PointLight{{0, 0, 1}, ConstantSpectrum{1}});
  EXPECT_EQ(variety(make(points), {1, 0, 0}), Variety::none);
  points.add(PointLight{{0, 0, 1}, ConstantSpectrum{1}});
  EXPECT_EQ(variety(make(points), {1, 0, 0}), Variety::little);
  // A sun, mostly hidden, would take the place of others.
  World sun;
  sun.add(DistantLight{{0, 0, 1}, ConstantSpectrum{1}});
  EXPECT_EQ(variety(make(sun), {1, 0, 0}), Variety::none);
  sun.add(PointLight{{0, 0, 1}, ConstantSpectrum{1}});
  EXPECT_EQ(variety(make(sun), {1, 0, 0}), Variety::none);
  World sky = lamp;
  sky.add(SkyLight{});
  EXPECT_EQ(variety(make(sky), {0.5, 0.5, 1}), Variety::none);
}

}  // namespace vitrail::light_sampler_test
