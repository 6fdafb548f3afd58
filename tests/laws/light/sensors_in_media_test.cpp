// SPDX-License-Identifier: Apache-2.0
// Sensors measure in the medium of their own place, wherever the camera is that they take the place of.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "film/sensor_readings.h"
#include "scene/daylight/photometry.h"
#include "scene/system/diagnostics.h"
#include "tests/laws/light/media_scenes.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::sensors_in_media_test {
namespace {

const Material black{DiffuseMaterial{ConstantSpectrum{0}}};
constexpr double intensity = 10, height = 2;

class SensorsInMedia : public testing::Test {
 protected:
  SensorsInMedia() {
    std::ofstream(sensors) << "0 0 0  0 0 1\n";
    scene.settings.max_depth = 1;
    // A lamp above the sensor, and a speck so that there is something.
    scene.lights.push_back({PointLight{{0, 0, height}, ConstantSpectrum{static_cast<float>(intensity)}}, {}});
    add_shape(scene, add_quads(scene, {{{{5, 0, -4}, {5.1f, 0, -4}, {5.1f, 0.1f, -4}, {5, 0.1f, -4}}}}),
              black);
    put_camera({0, -20, 0});
  }
  void put_camera(Point3d eye) { set_camera(scene, eye, eye + Vector3d{0, 1, 0}, {0, 0, 1}, 0.5, 8, 8); }
  Id<Medium> add_medium(double sigma_a) {
    scene.media.push_back(absorbing(sigma_a, false));
    return {static_cast<std::uint32_t>(scene.media.size() - 1)};
  }
  // A ball or a cube of it.
  void add_body(bool round, Point3d center, double reach, std::optional<Id<Medium>> interior,
                std::optional<Id<Medium>> exterior = std::nullopt,
                const Material& material = {InterfaceMaterial{}}) {
    const Vector3d corner{reach, reach, reach};
    if (round)
      add_quadric(scene, {}, ball(center, reach), material);
    else
      add_shape(scene,
                add_quads(scene, box_faces(cast<float>(center - corner), cast<float>(center + corner))),
                material);
    scene.shapes.back().interior = interior, scene.shapes.back().exterior = exterior;
  }
  Rendered rendered(std::uint32_t domains = 1) const {
    RenderOptions options;
    options.picture.samples_per_pixel = 64;
    options.picture.sensors = sensors;
    return render(scene, std::move(options), domains);
  }
  void expect_after(double optical_depth, const std::string& what) {
    const Measured found = sensor_readings(rendered().film)[0].illuminance_lx;
    const double expected = photometric(intensity / (height * height)) * std::exp(-optical_depth);
    fmt::print("{}: {:.6g} ± {:.2g} of {:.6g}\n", what, found.mean, found.standard_error, expected);
    EXPECT_NEAR(found.mean, expected, 5 * found.standard_error + 1e-3 * expected) << what;
    EXPECT_LT(found.standard_error, 0.02 * expected) << what;
  }

  TemporaryDirectory folder;
  std::filesystem::path sensors = folder / "sensors.txt";
  Scene scene;
};

TEST_F(SensorsInMedia, OutsideOfTheCameras) {
  for (const bool round : {false, true}) {
    add_body(round, {0, -20, 0}, 3, scene.camera_medium = add_medium(0.5));
    expect_after(0, "clear air, the camera in fog");
    scene.shapes.pop_back();
  }
}

TEST_F(SensorsInMedia, InsideOfTheirOwn) {
  for (const bool round : {false, true})
    for (const double reach : {1.0, 3.0}) {
      add_body(round, {0, 0, 0}, reach, add_medium(0.5));
      expect_after(0.5 * std::min(reach, height), fmt::format("fog around the sensor to {}", reach));
      scene.shapes.pop_back();
    }
}

// The body around is told from the one in it by the first boundary on the way out.
TEST_F(SensorsInMedia, Nested) {
  const Id<Medium> thin = add_medium(0.2), thick = add_medium(0.7);
  add_body(true, {0, 0, 0}, 1, thick, thin);
  add_body(false, {0, 0, 0}, 3, thin);
  expect_after(0.7 * 1 + 0.2 * 1, "thick fog in thin fog");
  scene.shapes.pop_back();
  scene.shapes.pop_back();
  // Beside the sensor: none is crossed on its way.
  add_body(true, {0.6, 0, 0}, 0.5, thick, thin);
  add_body(false, {0, 0, 0}, 3, thin);
  expect_after(0.2 * 2, "beside thick fog in thin fog");
}

// What is around all is what the camera is in, or is around the bubble that it is in.
TEST_F(SensorsInMedia, WithoutEnd) {
  scene.camera_medium = add_medium(0.3);
  expect_after(0.3 * 2, "fog without end");
  add_body(true, {0, 0, 5}, 1, add_medium(2), scene.camera_medium);
  expect_after(0.3 * 2, "fog without end around other fog");
  scene.shapes.pop_back();
  const auto fog = scene.camera_medium;
  scene.camera_medium = std::nullopt;
  add_body(true, {0, -20, 0}, 3, std::nullopt, fog);
  expect_after(0.3 * 2, "fog without end, the camera in a bubble of air");
}

// Its boundary tells by how often it was crossed.
TEST_F(SensorsInMedia, InALiquidOfPriority) {
  for (const int priority : {0, 1})
    for (const bool round : {false, true}) {
      DielectricMaterial water;
      water.eta = ConstantSpectrum{1.33f};
      water.priority = priority;
      add_body(round, {0, 0, 0.5}, 2.5, add_medium(0.4), std::nullopt, Material{water});
      expect_after(0.4 * 2, fmt::format("under water of priority {}", priority));
      scene.shapes.pop_back();
    }
}

// A floor that the sensor lies in, and a lattice that light passes unchanged, tell nothing.
TEST_F(SensorsInMedia, OnAFloor) {
  add_body(false, {0, 0, 0}, 3, add_medium(0.5));
  add_shape(scene, add_quads(scene, {{{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}}}), black);
  add_shape(scene, add_quads(scene, {{{{-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}}}}),
            {InterfaceMaterial{}});
  expect_after(0.5 * 2, "on a floor in fog");
  scene.shapes.back().exterior = add_medium(3);
  scene.shapes.back().opacity = 0.0f;
  expect_after(0.5 * 2, "under a boundary that is not there");
}

TEST_F(SensorsInMedia, AreTheSameWhateverTheDomains) {
  DielectricMaterial water;
  water.priority = 2;
  const Id<Medium> thin = add_medium(0.2);
  add_body(true, {0, 0, 0}, 1, add_medium(0.7), thin);
  add_body(false, {0, 0, 0}, 3, thin, std::nullopt, Material{water});
  for (int i = 0; i < 40; ++i) add_body(i % 2, {i - 20.0, 4, 0.1 * i}, 0.3, thin);
  std::ofstream(sensors) << "0 0 0  0 0 1\n-19 4 0.1  1 0 0\n0 0 2  0 1 0\n9 9 9  -1 0 0\n";
  const Rendered one = rendered(), eight = rendered(8);
  EXPECT_EQ(one.film.hash(), eight.film.hash());
  EXPECT_GT(sensor_readings(one.film)[0].illuminance_lx.mean, 0);
}

TEST_F(SensorsInMedia, AreNotClamped) {
  RenderOptions options;
  options.picture.samples_per_pixel = 1;
  options.picture.sensors = sensors;
  options.picture.clamp = 1;
  EXPECT_THROW(render(scene, std::move(options)), UsageError);
}

}  // namespace
}  // namespace vitrail::test::sensors_in_media_test
