// SPDX-License-Identifier: Apache-2.0
// What POV-Ray's scenes light with: lamps without fall-off, surfaces that are seen and light nothing, colours
// by patterns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/models/pattern.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/long_tests.h"
#include "tracer/photons/progressive.h"

namespace vitrail::test::povray_lights_test {
namespace {

const Material white{DiffuseMaterial{ConstantSpectrum{1}}}, black{DiffuseMaterial{ConstantSpectrum{0}}};

Rendered with(const Scene& scene, Integrator integrator, int samples, std::uint32_t domains = 1) {
  RenderOptions options;
  options.picture.samples_per_pixel = samples;
  options.picture.integrator = integrator;
  return render(scene, std::move(options), domains);
}

void expect_mean(const std::string& what, const Scene& scene, Integrator integrator, double expected,
                 int samples = 64) {
  const Brightness seen = brightness(with(scene, integrator, samples).film);
  fmt::print("{}: {:.6g} ± {:.2g} of {:.6g}\n", what, seen.mean, seen.standard_error, expected);
  EXPECT_NEAR(seen.mean, expected, 4.5 * seen.standard_error + 2e-4 * expected) << what;
}

Scene floor_seen(const Material& material = white) {
  Scene scene;
  add_shape(scene, square(scene, 0, 2), material);
  look_along(scene, {0, 0, 1}, {}, 1e-4);
  return scene;
}

Medium fog_of(double sigma, double radiance) {
  Medium fog;
  fog.coefficients = AbsorptionScattering{ConstantSpectrum{static_cast<float>(sigma)}, ConstantSpectrum{0}};
  fog.emission = ConstantSpectrum{static_cast<float>(radiance)};
  fog.veils = true;
  return fog;
}

// ---- Lamps

TEST(PovrayLights, WithoutFallOff) {
  for (const double distance : {1e-3, 1.0, 1e6})
    for (const double cosine : {1.0, 0.3}) {
      Scene scene = floor_seen();
      look_along(scene, {0, 0, 1}, {}, 1e-7);
      const double sine = std::sqrt(1 - cosine * cosine);
      scene.lights.push_back(
          {PointLight{{sine * distance, 0, cosine * distance}, ConstantSpectrum{2}, Fading{}}, {}});
      const std::string what = fmt::format("at {}, cosine {}", distance, cosine);
      expect_mean(what, scene, Integrator::direct, 2 * cosine / pi, 4);
      expect_mean(what, scene, Integrator::path, 2 * cosine / pi, 4);
    }
}

TEST(PovrayLights, ManyInOneTree) {
  Scene scene = floor_seen();
  scene.settings.max_depth = 1;
  double expected = 0;
  for (int i = 0; i < 60; ++i) {
    const double x = i < 30 ? 0.1 * i : 1000.0 * (i - 29), z = 1 + i % 7;
    const std::optional<Fading> fading = i % 2 ? Fading{} : Fading{2, 2};
    const double d2 = x * x + z * z;
    scene.lights.push_back({PointLight{{x, 0, z}, ConstantSpectrum{1}, fading}, {}});
    expected += z / std::sqrt(d2) * (i % 2 ? 1 : 2 / (1 + d2 / 4)) / pi;
  }
  expect_mean("60 lamps", scene, Integrator::path, expected, 512);
}

// A photon is worth I·f(d)·d² where it first meets a surface: behind a sheet of index 1 it then thins out as
// 1/d², so that the floor below gets I·cos θ of the quarter of the way that the sheet is at.
TEST(PovrayLights, PhotonsBehindASheet) {
  Scene scene;
  add_shape(scene, square(scene, 0, 2), Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  DielectricMaterial sheet;
  sheet.eta = ConstantSpectrum{1};
  add_shape(scene, square(scene, 0.5f, 2), Material{sheet});
  scene.lights.push_back({PointLight{{0, 0, 1}, ConstantSpectrum{3}, Fading{}}, {}});
  look_along(scene, {0, 0, 1}, {}, 0.01);
  constexpr int iterations = 64;
  RenderOptions options;
  options.picture.samples_per_pixel = iterations;
  options.picture.integrator = Integrator::photon;
  const PhotonKey key{40000, 0.25, 0.8};
  options.picture.photons = {key.photons, key.first_radius, key.alpha};
  double expected = 0;
  for (std::uint32_t i = 0; i < iterations; ++i) {
    const double r = radius_of(key, i);
    expected += 3 * 0.25 * 2 / (r * r) * (std::sqrt(1 + r * r) - 1) * 0.5 / pi / iterations;
  }
  EXPECT_NEAR(brightness(render(scene, std::move(options)).film).mean, expected, 0.02 * expected);
}

// ---- Glows

AreaLight glow(float radiance, bool sampled = false) {
  AreaLight light;
  light.radiance = Spectrum{ConstantSpectrum{radiance}};
  light.sampled = sampled;
  light.two_sided = true;
  return light;
}

// Above the floor, seen from the side alone.
Scene under_a_glow(bool sampled) {
  Scene scene = floor_seen();
  add_shape(scene, square(scene, 0.5f, 0.4f), black, glow(3, sampled));
  OrthographicCamera camera = std::get<OrthographicCamera>(scene.camera);
  camera.camera_to_world = look_at({0, 0, 0.01}, {0, 0, 0}, {0, 1, 0});
  scene.camera = camera;
  return scene;
}

TEST(PovrayLights, GlowIsSeen) {
  for (const Integrator integrator : {Integrator::direct, Integrator::path}) {
    Scene scene;
    add_shape(scene, square(scene, 0, 2), black, glow(3));
    look_along(scene, {0, 0, 1}, {}, 0.05);
    expect_mean("a glow", scene, integrator, 3, 4);
    // In a mirror.
    Scene mirrored;
    ConductorMaterial mirror;
    mirror.metal = PerfectReflector{};
    mirror.roughness.alpha_u = mirror.roughness.alpha_v = 0.0f;
    add_shape(mirrored, square(mirrored, 0, 2), Material{mirror});
    add_shape(mirrored, square(mirrored, 20, 30), black, glow(3));
    look_along(mirrored, direction(30), {}, 0.05);
    expect_mean("a glow in a mirror", mirrored, integrator, 3, 4);
    // Through glass, which lets 0.9216 of the light through a face, and shows of what is behind 1/n².
    Scene behind;
    DielectricMaterial sheet;
    sheet.eta = ConstantSpectrum{1};
    add_shape(behind, square(behind, 0.5f, 2), Material{sheet});
    add_shape(behind, square(behind, 0, 2), black, glow(3));
    look_along(behind, {0, 0, 1}, {0, 0, 0.5}, 0.05);
    expect_mean("a glow behind glass", behind, integrator, 3, 4);
  }
}

TEST(PovrayLights, GlowLightsNothingDirectly) {
  EXPECT_EQ(brightness(with(under_a_glow(false), Integrator::direct, 64).film).mean, 0);
  EXPECT_GT(brightness(with(under_a_glow(true), Integrator::direct, 64).film).mean, 0.1);
}

// The form factor of a centred square of half the width a, at a distance h: 4/(2π)·2·s·atan(s), s the share
// a/√(a² + h²) (Howell, B-4).
TEST(PovrayLights, GlowIsFoundByPaths) {
  const double a = 0.4, h = 0.5, s = a / std::sqrt(a * a + h * h);
  const double factor = 4 / (2 * pi) * 2 * s * std::atan(s);
  for (const bool sampled : {false, true}) {
    Scene scene = under_a_glow(sampled);
    scene.settings.max_depth = 1;
    expect_mean(sampled ? "a lamp" : "a glow", scene, Integrator::path, 3 * factor, 4096);
  }
}

// 10⁴ triangles: none of them is in the bundle's lights.
TEST(PovrayLights, GlowsAreNoLamps) {
  Scene scene = under_a_glow(false);
  std::vector<std::array<Point3f, 4>> many;
  for (int i = 0; i < 5000; ++i) {
    const auto x = static_cast<float>(i);
    many.push_back({{{x, 5, 0}, {x + 1, 5, 0}, {x + 1, 6, 0}, {x, 6, 0}}});
  }
  add_shape(scene, add_quads(scene, many), black, glow(1));
  EXPECT_EQ(with(scene, Integrator::direct, 1).stats.refused, Refused{});
  EXPECT_EQ(brightness(with(scene, Integrator::direct, 16).film).mean, 0);
}

// ---- Patterns

// Under parallel light, of one ray through every pixel: the mean is that of the pattern's own function.
Scene painted(const PatternTexture& pattern) {
  Scene scene;
  scene.textures.push_back({pattern});
  add_shape(scene, square(scene, 0, 4), Material{DiffuseMaterial{Id<Texture>{0}}});
  scene.lights.push_back({DistantLight{{0, 0, -1}, ConstantSpectrum{static_cast<float>(pi)}}, {}});
  look_along(scene, {0, 0, 1}, {}, 3);
  scene.settings.max_depth = 1;
  return scene;
}

TEST(PovrayLights, PatternsColourSurfaces) {
  using Kind = PatternTexture::Kind;
  for (const Kind kind : {Kind::checker, Kind::spherical, Kind::bozo, Kind::crackle, Kind::marble}) {
    PatternTexture pattern;
    pattern.kind = kind;
    pattern.texture_to_world = translate({0.3, 0.2, 0.1}) * scale({1.5, 1, 1});
    pattern.map = {{0, ConstantSpectrum{0.25f}}, {1, ConstantSpectrum{0.75f}}};
    const Scene scene = painted(pattern);
    double expected = 0;
    constexpr int n = 600;
    const Transform to_texture = inverse(pattern.texture_to_world);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Point3d p{6 * (i + 0.5) / n - 3, 6 * (j + 0.5) / n - 3, 0};
        const PatternMix mix = pattern_mix(pattern, transform_point(to_texture, p));
        const auto value = [](std::size_t place) { return place == 0 ? 0.25 : 0.75; };
        expected += ((1 - mix.amount) * value(mix.first) + mix.amount * value(mix.second)) / (n * n);
      }
    expect_mean(fmt::format("pattern {}", static_cast<int>(kind)), scene, Integrator::direct, expected, 256);
  }
}

// One picture, however it is cut: whether a ray stays or is sent is a matter of luck, so more than once.
TEST(PovrayLights, OnePicture) {
  PatternTexture pattern;
  pattern.kind = PatternTexture::Kind::granite;
  pattern.turbulence.amount = {1, 1, 1};
  pattern.map = {{0, ConstantSpectrum{0.25f}}, {1, ConstantSpectrum{0.75f}}};
  Scene scene = lit_box(of_all(32, 16));
  scene.textures.push_back({pattern});
  const Id<Texture> texture{static_cast<std::uint32_t>(scene.textures.size() - 1)};
  for (Material& material : scene.materials)
    if (auto* diffuse = std::get_if<DiffuseMaterial>(&material.model)) diffuse->reflectance = texture;
  for (int i = 0; i < 20; ++i)
    scene.lights.push_back({PointLight{{0.1 * i, 0.2, 0.3},
                                       ConstantSpectrum{0.1f},
                                       i % 2 ? std::optional(Fading{}) : std::optional(Fading{1, 2})},
                            {}});
  const auto expect_one_picture = [&](const char* what) {
    for (const Integrator integrator : {Integrator::path, Integrator::direct, Integrator::photon}) {
      if (integrator == Integrator::photon && !scene.media.empty()) continue;  // refused
      const std::uint64_t hash = with(scene, integrator, 4).film.hash();
      for (const std::uint32_t domains : {4u, 16u})
        EXPECT_EQ(with(scene, integrator, 4, domains).film.hash(), hash)
            << what << ", " << domains << " domains, integrator " << static_cast<int>(integrator);
    }
  };
  expect_one_picture("lamps");
  AreaLight shining = glow(0.5f);
  shining.radiance = texture;
  add_shape(scene, square(scene, 0.1f, 0.2f), white, shining);
  expect_one_picture("lamps and a glow");
  PatternTexture bumps;
  bumps.kind = PatternTexture::Kind::wrinkles;
  bumps.map = {{0, ConstantSpectrum{0}}, {1, ConstantSpectrum{0.05f}}};
  scene.textures.push_back({bumps, true, "", {}});
  for (Material& material : scene.materials)
    material.displacement = Id<Texture>{static_cast<std::uint32_t>(scene.textures.size() - 1)};
  expect_one_picture("bumps");
  scene.media.push_back(fog_of(0.3, 0.2));
  scene.camera_medium = Id<Medium>{0};
  expect_one_picture("bumps in fog");
}

// ---- Normals by patterns

// On a floor that rises by half of x, and on the same pattern three times as large along z: the height is
// measured in the pattern's space. From a low eye that floor's normal looks away, and is as bright.
TEST(PovrayLights, NormalsOfPatterns) {
  for (const Vector3d& out : {Vector3d{0, 0, 1}, Vector3d{0.96, 0, 0.28}})
    for (const double tall : {1.0, 3.0})
      for (const double sine : {-0.6, 0.6}) {
        Material bumpy = white;
        bumpy.displacement = Id<Texture>{0};
        Scene scene = floor_seen(bumpy);
        PatternTexture ramp;
        ramp.kind = PatternTexture::Kind::gradient;
        ramp.texture_to_world = scale({1, 1, tall});
        ramp.map = {{0, Spectrum{ConstantSpectrum{0}}}, {1, Spectrum{ConstantSpectrum{0.5f}}}};
        scene.textures.push_back({ramp, true, "", {}});
        look_along(scene, out, {0.4, 0, 0}, 1e-4);
        scene.lights.push_back({DistantLight{{-sine, 0, -0.8}, ConstantSpectrum{1}}, {}});
        const double slope = 0.5 * tall;
        const double cosine = (0.8 - slope * sine) / std::sqrt(1 + slope * slope);
        const std::string what = fmt::format("seen from {}, light from {}, {} tall", out.x, sine, tall);
        expect_mean(what, scene, Integrator::direct, std::max(cosine, 0.0) / pi, 4);
        expect_mean(what, scene, Integrator::path, std::max(cosine, 0.0) / pi, 4);
      }
}

// ---- Fog

// Between the eye and a floor that is 20 away it absorbs and shines; what a lamp that fades as POV-Ray's
// sends it lets through, but not what others do. With direct light alone it lights nothing; with paths
// all of what is around a white floor shines.
TEST(PovrayLights, FogIsAVeil) {
  constexpr double sigma = 0.05, shines = 0.7, height = 5;
  const double left = std::exp(-sigma * 20);
  for (const bool fades : {true, false})
    for (const Integrator integrator : {Integrator::direct, Integrator::path}) {
      Scene scene = floor_seen();
      PointLight lamp{{0, 0, height}, ConstantSpectrum{2}};
      if (fades) lamp.fading = Fading{};
      scene.lights.push_back({lamp, {}});
      scene.media.push_back(fog_of(sigma, shines));
      scene.camera_medium = Id<Medium>{0};
      scene.settings.max_depth = 1;
      const double around = integrator == Integrator::path ? shines * left : 0;
      const double lit = fades ? 2 / pi : 2 / pi * std::exp(-sigma * height) / (height * height);
      expect_mean(fades ? "fog, a lamp that fades" : "fog, another lamp", scene, integrator,
                  lit * left + shines * (1 - left) + around, 4);
    }
}

// A grid that shines and lets all through: as bright as its emission is long, with little chance in it.
TEST(PovrayLights, ThinGridsShine) {
  constexpr float thin = 1e-5f, emission = 0.3f;
  Scene scene = floor_seen(black);
  Medium medium;
  medium.coefficients = AbsorptionScattering{ConstantSpectrum{thin}, ConstantSpectrum{0}};
  medium.emission = ConstantSpectrum{emission / thin};
  Grid ones;
  ones.nx = ones.ny = ones.nz = 2;
  ones.values.assign(8, 1.0f);
  ones.bounds = {{-1, -1, -1}, {1, 1, 1}};
  medium.density = ones;
  scene.media.push_back(medium);
  scene.camera_medium = Id<Medium>{0};
  for (const Integrator integrator : {Integrator::direct, Integrator::path})
    expect_mean("a thin grid", scene, integrator, static_cast<double>(emission), 16);
}

}  // namespace
}  // namespace vitrail::test::povray_lights_test
