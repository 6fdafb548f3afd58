// SPDX-License-Identifier: Apache-2.0
// Direct light alone, by shadow rays that pass glass with its spectral transmittance, and by mirrors.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "film/film_progress.h"
#include "glazing/system_file.h"
#include "importers/reading/glazing_material.h"
#include "partitioner/partition.h"
#include "scene/geometry/portable_math.h"
#include "tests/glazing/glazing_files.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/long_tests.h"
#include "tracer/bsdf/local.h"

namespace vitrail::test::local_illumination_test {
namespace {

constexpr float wide = 1e5f, above_the_camera = 25, albedo = 0.6f;

// Grey ground that the camera sees from straight above, from below what is above the camera.
Scene ground(const LightModel& light) {
  Scene scene;
  add_shape(scene, square(scene, 0), Material{DiffuseMaterial{ConstantSpectrum{albedo}}});
  scene.lights.resize(1);
  scene.lights[0].model = light;
  look_along(scene, {0, 0, 1}, {}, 0.01);
  scene.settings.direct_only = true;
  scene.settings.max_depth = 10;
  return scene;
}

void add_glass(Scene& scene, const std::string& file, int panes) {
  const auto add = [&](Material m) {
    scene.materials.push_back(std::move(m));
    return Id<Material>{static_cast<std::uint32_t>(scene.materials.size() - 1)};
  };
  for (int i = 0; i < panes; ++i) {
    Material glass{glazing_model(file, add).model};
    add_shape(scene, square(scene, above_the_camera + static_cast<float>(i), wide), glass);
  }
}

DistantLight sun(double theta_deg) { return {-direction(theta_deg, 30), ConstantSpectrum{1}}; }

// Luminance of ∏T at the angle, of equal energy.
double transmitted(const std::string& file, int panes, double cosine) {
  const GlazingSystem system = read_system({file}).system;
  std::vector<std::array<double, 2>> samples;
  for (double nm = lambda_min_nm; nm <= lambda_max_nm; ++nm)
    samples.push_back({nm, std::pow(system_values(system, nm, cosine, Polarisation::apart).t, panes)});
  return luminance(Spectrum{tabulate(samples, true)});
}

// 2∫ value(cos θ) cos θ d(cos θ), by midpoints.
double over_sky(auto value) {
  constexpr int steps = 200;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double cosine = (i + 0.5) / steps;
    sum += 2 * cosine * value(cosine) / steps;
  }
  return sum;
}

class LocalIllumination : public ::testing::Test {
 protected:
  LocalIllumination() {
    write_text(
        directory / "blue.txt",
        "wavelength_nm T Rf Rb\n300 0.7 0.05 0.05\n450 0.8 0.1 0.05\n550 0.5 0.05 0.15\n650 0.3 0.2 0.1\n"
        "2500 0.1 0.2 0.2\n");
    file = (directory / "blue.json").string();
    write_text(file, R"({"layers": [{"pane": "blue.txt"}]})");
  }
  TemporaryDirectory directory;
  std::string file;
};

TEST_F(LocalIllumination, ASunBehindPanes) {
  for (const double theta : {0.0, 50.0})
    for (const int panes : {1, 3}) {
      Scene scene = ground(sun(theta));
      add_glass(scene, file, panes);
      const double cosine = std::cos(theta * std::numbers::pi / 180);
      expect_luminance(
          mean_of(render(scene, of_all(256, 128)).film),
          static_cast<double>(albedo) / std::numbers::pi * cosine * transmitted(file, panes, cosine), 0.003,
          std::to_string(panes) + " panes at " + std::to_string(theta), 1e-3);
    }
}

// Lamps are found by their own samples and by those of what they light: both have to pass the panes.
TEST_F(LocalIllumination, ASkyBehindPanes) {
  for (const bool counts : {true, false})
    for (const int panes : {1, 2}) {
      Scene scene = ground(InfiniteLight{ConstantSpectrum{1}});
      scene.settings.straight_counts = counts;
      add_glass(scene, file, panes);
      expect_luminance(mean_of(render(scene, of_all(1024, 512)).film),
                       static_cast<double>(albedo) *
                           over_sky([&](double cosine) { return transmitted(file, panes, cosine); }),
                       0.003, std::to_string(panes) + " panes", 1e-3);
    }
}

TEST_F(LocalIllumination, SmoothGlassIsASheet) {
  const auto lets = [](double cosine) { return std::pow(1 - fresnel_dielectric(cosine, 1.5), 2); };
  const auto block = [&](Scene scene) {
    add_shape(
        scene,
        add_quads(scene, box_faces({-wide, -wide, above_the_camera}, {wide, wide, above_the_camera + 1})),
        Material{DielectricMaterial{}});
    return mean_of(render(scene, of_all(1024, 512)).film);
  };
  const double cosine = std::cos(50 * std::numbers::pi / 180);
  expect_luminance(block(ground(InfiniteLight{ConstantSpectrum{1}})),
                   static_cast<double>(albedo) * over_sky(lets), 0.003, "sky", 1e-3);
  expect_luminance(block(ground(sun(50))),
                   static_cast<double>(albedo) / std::numbers::pi * cosine * lets(cosine), 0.003, "sun",
                   1e-3);
}

// A mirror shows what a lamp lights, and glass what lies behind it.
TEST_F(LocalIllumination, MirrorsAndRefractedRaysAreFollowed) {
  const double lit = static_cast<double>(albedo) / std::numbers::pi * std::cos(50 * std::numbers::pi / 180);
  Scene mirrored = ground(sun(50));
  // At 45° over the ground, seen from the side.
  add_shape(mirrored, add_quads(mirrored, {{{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 3}, {1, -1, 3}}}}),
            Material{ConductorMaterial{PerfectReflector{}, {}, ConstantSpectrum{0.9f}}});
  look_along(mirrored, {1, 0, 0}, {0, 0, 2}, 0.01);
  expect_luminance(mean_of(render(mirrored, 64).film), 0.9 * lit, 0.003, "mirror", 1e-3);

  Scene behind = ground(sun(50));
  add_shape(behind, add_quads(behind, box_faces({-1, -1, 1}, {1, 1, 1.2f})), Material{DielectricMaterial{}});
  // The sun does not pass the block on its way to what is seen: it stands at 50°.
  const double face = fresnel_dielectric(1, 1.5), all = (1 - face) / (1 + face);
  expect_luminance(mean_of(render(behind, of_all(1024, 512)).film), all * lit, 0.01, "refracted", 1e-3);
}

// What the last mirror shows is black: a lamp and the sky as well as what they light. What is lit there finds
// lamps by its own samples all the same.
TEST_F(LocalIllumination, TheLastMirrorShowsNothing) {
  for (const bool sky : {false, true})
    for (const int depth : {1, 2}) {
      Scene scene;
      add_shape(scene, add_quads(scene, {{{{-1, -1, -1}, {-1, 1, -1}, {1, 1, 1}, {1, -1, 1}}}}),
                Material{ConductorMaterial{PerfectReflector{}, {}, ConstantSpectrum{0.9f}}});
      if (sky)
        scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}});
      else
        add_shape(scene, square(scene, -50, wide), Material{DiffuseMaterial{ConstantSpectrum{0}}},
                  AreaLight{ConstantSpectrum{1}, true});
      look_along(scene, {1, 0, 0}, {}, 0.01);
      scene.settings.direct_only = true;
      scene.settings.max_depth = depth;
      EXPECT_NEAR(mean_of(render(scene, 64).film).value.y, depth == 1 ? 0 : 0.9, 1e-3)
          << (sky ? "sky" : "lamp") << " of depth " << depth;
    }
  Scene lit = ground(InfiniteLight{ConstantSpectrum{1}});
  lit.settings.max_depth = 1;
  expect_luminance(mean_of(render(lit, of_all(1024, 512)).film), static_cast<double>(albedo), 0.003,
                   "under the sky", 1e-3);
}

Film with_threshold(const Scene& scene, double threshold) {
  const TemporaryDirectory directory;
  partition(scene, directory / "scene.vit", {.domains = 1});
  RenderOptions options;
  options.bundle = directory / "scene.vit";
  options.outputs.film = directory / "scene.film";
  options.picture.samples_per_pixel = 16;
  options.picture.threshold = threshold;
  int argc = 0;
  char** argv = nullptr;
  vitrail::render(*make_transport(&argc, &argv), options);
  return read_film(options.outputs.film, nullptr);
}

// Sheets of T = 1/2 over a lamp: what is not followed any more brings less than the threshold.
TEST_F(LocalIllumination, TheThresholdIsTheMostThatIsLost) {
  MeasuredSheet half;
  half.wavelengths_nm = {550}, half.cosines = {1}, half.reflectance = {0}, half.transmittance = {0.5f};
  for (const int sheets : {1, 2, 3, 4}) {
    Scene scene;
    add_shape(scene, square(scene, -1), Material{DiffuseMaterial{ConstantSpectrum{0}}},
              AreaLight{ConstantSpectrum{1}});
    for (int i = 0; i < sheets; ++i)
      add_shape(scene, square(scene, static_cast<float>(i)), Material{MeasuredMaterial{"", half}});
    look_along(scene, {0, 0, 1}, {}, 0.01);
    scene.settings.direct_only = true;
    scene.settings.max_depth = 10;
    const double brings = std::pow(0.5, sheets), seen = mean_of(with_threshold(scene, 0.2)).value.y;
    EXPECT_NEAR(mean_of(with_threshold(scene, 0)).value.y, brings, 1e-3 * brings);
    EXPECT_NEAR(seen, sheets < 3 ? brings : 0, 1e-3) << sheets;
    EXPECT_LE(brings - seen, 0.2);
  }
  Scene scene = ground(sun(0));
  const Film with = with_threshold(scene, 0.2), without = with_threshold(scene, 0);
  EXPECT_NE(difference(with, without), "") << "a film says its threshold";
}

TEST_F(LocalIllumination, IsOnePicture) {
  Scene scene = ground(InfiniteLight{ConstantSpectrum{1}});
  add_glass(scene, file, 2);
  add_shape(scene, add_quads(scene, box_faces({-1, -1, 1}, {1, 1, 1.2f})), Material{DielectricMaterial{}});
  add_shape(scene, add_quads(scene, box_faces({2, 2, 1}, {3, 3, 2})), Material{DielectricMaterial{}});
  const std::uint64_t hash = render(scene, 16).film.hash();
  for (const std::uint32_t domains : {3u, 8u})
    EXPECT_EQ(render(scene, 16, domains).film.hash(), hash) << domains;
}

}  // namespace
}  // namespace vitrail::test::local_illumination_test
