// SPDX-License-Identifier: Apache-2.0
// What POV-Ray's scenes show of lamps: highlights that are not normalised, no shadows, media that weaken no
// lamp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/laws/light/flat_scenes.h"
#include "tracer/bsdf/glazed.h"
#include "tracer/bsdf/local.h"

namespace vitrail::test::povray_surfaces_test {
namespace {

const Material white{DiffuseMaterial{ConstantSpectrum{1}}};

Rendered with(const Scene& scene, Integrator integrator, int samples, std::uint32_t domains = 1) {
  RenderOptions options;
  options.picture.samples_per_pixel = samples;
  options.picture.integrator = integrator;
  return render(scene, std::move(options), domains);
}

void expect_mean(const std::string& what, const Scene& scene, double expected, int samples = 16) {
  const Brightness seen = brightness(with(scene, Integrator::direct, samples).film);
  fmt::print("{}: {:.6g} ± {:.2g} of {:.6g}\n", what, seen.mean, seen.standard_error, expected);
  EXPECT_NEAR(seen.mean, expected, 4.5 * seen.standard_error + 5e-4 * expected + 1e-7) << what;
}

// A plane seen from `out`, and a lamp far off along `in` that shows reflectance 1 as cos θ.
Scene seen(const Material& material, Vector3d out, Vector3d in, bool shadows = true) {
  Scene scene;
  add_shape(scene, square(scene, 0, 2), material);
  look_along(scene, out, {}, 1e-4);
  scene.lights.push_back(
      {PointLight{Point3d{} + in * 1e4, ConstantSpectrum{static_cast<float>(pi)}, Fading{}}, {}});
  scene.lights.back().casts_shadows = shadows;
  return scene;
}

// POV-Ray's own pictures show s·(r·l)^size and s·(n·h)^(1/roughness), without a cosine.
TEST(PovraySurfaces, HighlightsAddUp) {
  FinishMaterial finish{ConstantSpectrum{0.3f}, ConstantSpectrum{1}};
  finish.phong = 0.5f, finish.phong_size = 10, finish.specular = 0.25f, finish.roughness = 0.1f;
  for (const double view_deg : {0.0, 50.0})
    for (const double light_deg : {0.0, 25.0, 60.0}) {
      const Vector3d out = direction(view_deg), in = direction(light_deg, 180);
      const Vector3d h = normalize(out + in);
      const double mirrored = std::max(out.z * in.z - out.x * in.x - out.y * in.y, 0.0);
      const double expected = 0.3 * in.z + 0.5 * std::pow(mirrored, 10) + 0.25 * std::pow(h.z, 10);
      expect_mean(fmt::format("seen at {}, lit at {}", view_deg, light_deg), seen(Material{finish}, out, in),
                  expected);
    }
  finish = {ConstantSpectrum{0.8f}, ConstantSpectrum{1}, 3};
  expect_mean("brilliance", seen(Material{finish}, direction(30), direction(60)), 0.8 / 8);
}

// Sampled directions and the density of asking for them are of one function.
TEST(PovraySurfaces, HighlightsUnderASky) {
  FinishMaterial finish{ConstantSpectrum{0.3f}, ConstantSpectrum{1}};
  finish.specular = 0.5f, finish.roughness = 0.2f, finish.phong = 0.2f, finish.phong_size = 4;
  const Vector3d out = direction(40);
  const double expected = over_sphere([&](Vector3d in) {
    if (in.z <= 0) return 0.0;
    const double mirrored = std::max(out.z * in.z - out.x * in.x - out.y * in.y, 0.0);
    return (0.3 * in.z + 0.5 * std::pow(normalize(out + in).z, 5) + 0.2 * std::pow(mirrored, 4)) / pi;
  });
  expect_luminance(plane_under_sky(Material{finish}, out, 256), expected, 0.01, "a finish under a sky", 1e-3);
}

TEST(PovraySurfaces, ShadowlessLampsHaveNoHighlights) {
  FinishMaterial finish{ConstantSpectrum{0.3f}, ConstantSpectrum{1}};
  finish.specular = 0.5f;
  for (const bool shadows : {true, false})
    for (const bool blocked : {true, false}) {
      Scene scene = seen(Material{finish}, direction(20), direction(20, 180), shadows);
      if (blocked) {
        add_shape(scene, square(scene, 30, 1), white);
        scene.shapes.back().object_to_world = translate({-30 * std::tan(20 * pi / 180), 0, 0});
      }
      const double diffuse = 0.3 * std::cos(20 * pi / 180);
      expect_mean(fmt::format("shadows {}, blocked {}", shadows, blocked), scene,
                  shadows ? (blocked ? 0 : diffuse + 0.5) : diffuse);
      const std::uint64_t hash = with(scene, Integrator::path, 4).film.hash();
      EXPECT_EQ(with(scene, Integrator::path, 4, 4).film.hash(), hash);
    }
  // From below no light comes, with shadows or without.
  expect_mean("from below", seen(white, direction(20), direction(160), false), 0);
}

TEST(PovraySurfaces, LightPassesWhatHasNoShadow) {
  for (const bool casts : {true, false}) {
    Scene scene = seen(white, direction(0), direction(40));
    add_shape(scene, square(scene, 1, 0.5), white);
    scene.shapes.back().object_to_world = translate({std::tan(40 * pi / 180), 0, 0});
    scene.materials.at(scene.shapes.back().material.value).casts_shadow = casts;
    expect_mean(casts ? "a square" : "one without shadow", scene, casts ? 0 : std::cos(40 * pi / 180));
    for (const Integrator integrator : {Integrator::direct, Integrator::path}) {
      const std::uint64_t hash = with(scene, integrator, 4).film.hash();
      for (const std::uint32_t domains : {4u, 16u})
        EXPECT_EQ(with(scene, integrator, 4, domains).film.hash(), hash) << domains;
    }
    // It is seen itself.
    look_along(scene, {0, 0, 1}, {std::tan(40 * pi / 180), 0, 1}, 1e-4);
    expect_mean("it", scene, std::cos(40 * pi / 180));
  }
}

// A medium that scatters around everything: POV-Ray shows c·(1 − e^(−s·d)) of it, and the floor behind
// weakened by e^(−s·d) alone, however far the lamp is.
TEST(PovraySurfaces, AnAtmosphereWeakensNoLamp) {
  for (const bool veils : {true, false}) {
    Scene scene = seen(white, direction(0), direction(0));
    scene.lights[0].model = PointLight{{0, 0, 5}, ConstantSpectrum{static_cast<float>(pi)}, Fading{}};
    look_along(scene, {0, 0, 1}, {}, 1e-4);
    OrthographicCamera camera = std::get<OrthographicCamera>(scene.camera);
    camera.camera_to_world = look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0});
    scene.camera = camera;
    Medium medium;
    medium.coefficients = ExtinctionAlbedo{ConstantSpectrum{0.2f}, ConstantSpectrum{4}};
    medium.veils = veils;
    scene.media.push_back(medium);
    scene.camera_medium = Id<Medium>{0};
    const double left = std::exp(-0.4);
    const double to_lamp = veils ? 1 : std::exp(-1.0);  // of the floor, 5 below the lamp
    // ∫ s·e^(−s·t)·e^(−s·(3 + t)) dt over the two units before the floor
    const double scattered = veils ? 1 - left : std::exp(-0.6) * (1 - std::exp(-0.8)) / 2;
    expect_mean(veils ? "an atmosphere" : "another medium", scene, left * to_lamp + scattered, 4096);
  }
}

// What mirrors, lets through, and shines with highlights adds up under a sky of 1: as much as POV-Ray's laws
// say.
TEST(PovraySurfaces, GlazedUnderASky) {
  GlazedMaterial glazed;
  glazed.finish = {ConstantSpectrum{0.3f}, ConstantSpectrum{1}};
  glazed.finish.specular = 0.5f, glazed.finish.roughness = 0.2f;
  glazed.mirror_min = ConstantSpectrum{0.1f}, glazed.mirror_max = ConstantSpectrum{0.5f};
  for (const double view_deg : {0.0, 40.0, 75.0})
    for (const bool fresnel : {false, true})
      for (const bool conserves : {false, true})
        for (const float through : {0.0f, 0.6f}) {
          const Vector3d out = direction(view_deg);
          const double lit = over_sphere([&](Vector3d in) {
            return in.z <= 0 ? 0.0 : (0.3 * in.z + 0.5 * std::pow(normalize(out + in).z, 5)) / pi;
          });
          glazed.fresnel = fresnel, glazed.conserves_energy = conserves;
          glazed.through = ConstantSpectrum{through};
          glazed.eta = 1.5f, glazed.falloff = 2;
          const double between = fresnel ? fresnel_dielectric(out.z, 1.5) : std::pow(1 - out.z, 2);
          const double mirrored = 0.1 + 0.4 * between;
          const double expected =
              lit + mirrored + static_cast<double>(through) * (conserves ? 1 - mirrored : 1);
          expect_luminance(plane_under_sky(Material{glazed}, out, 256), expected, 0.01,
                           fmt::format("glazed, {}°, fresnel {}, conserves {}, through {}", view_deg, fresnel,
                                       conserves, through),
                           1e-3);
        }
}

// Highlights are the same however much goes through, and a lamp behind shines through, bent or not.
TEST(PovraySurfaces, LampsAndClearSurfaces) {
  GlazedMaterial glazed;
  glazed.finish = {ConstantSpectrum{0.1f}, ConstantSpectrum{1}};
  glazed.finish.phong = 0.5f, glazed.finish.phong_size = 10;
  glazed.through = ConstantSpectrum{0.75f};
  for (const float eta : {1.0f, 1.5f}) {
    glazed.eta = eta;
    expect_mean(fmt::format("seen, index {}", eta), seen(Material{glazed}, direction(30), direction(30, 180)),
                0.1 * std::cos(30 * pi / 180) + 0.5);
    Scene scene = seen(white, direction(20), direction(20, 180));
    add_shape(scene, square(scene, 30, 1), Material{glazed});
    scene.shapes.back().object_to_world = translate({-30 * std::tan(20 * pi / 180), 0, 0});
    expect_mean(fmt::format("lit through it, index {}", eta), scene, 0.75 * std::cos(20 * pi / 180));
  }
}

// From inside beyond the critical angle all is mirrored, whatever the finish mirrors and lets through, as
// POV-Ray's pictures show; weights and chances agree.
TEST(PovraySurfaces, GlazedFromInside) {
  GlazedBsdf glazed;
  glazed.finish.reflectance = filled(0.2f);
  glazed.through = filled(0.6f), glazed.mirror_min = glazed.mirror_max = filled(0.1f), glazed.eta = 1.5;
  for (const double view_deg : {10.0, 60.0}) {
    const Vector3d out = -direction(view_deg);
    double mirrored = 0, through = 0;
    constexpr int n = 1 << 14;
    for (int i = 0; i < n; ++i) {
      const auto chosen = sample(glazed, out, (static_cast<float>(i) + 0.5f) / n, {0.3f, 0.4f});
      ASSERT_TRUE(chosen);
      if (!chosen->specular) continue;
      (chosen->in.z < 0 ? mirrored : through) += static_cast<double>(chosen->weight.v[0]) / n;
    }
    EXPECT_NEAR(mirrored, view_deg > 42 ? 1 : 0.1, 1e-3) << view_deg;
    EXPECT_NEAR(through, view_deg > 42 ? 0 : 0.6, 1e-3) << view_deg;
  }
}

}  // namespace
}  // namespace vitrail::test::povray_surfaces_test
