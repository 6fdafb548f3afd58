// SPDX-License-Identifier: Apache-2.0
// Daylight coefficients against closed forms: what each patch of an open sky, and each sun, gives to a
// sensor.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "cli/year/coefficients.h"
#include "scene/daylight/sun_position.h"
#include "scene/geometry/portable_math.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"
#include "tracer/prepared/daylight_rows.h"

namespace vitrail::test::daylight_coefficients_test {
namespace {

const Material grey{DiffuseMaterial{ConstantSpectrum{0.5f}}};

// A grey speck far below: a scene needs something in it.
Scene open_field() {
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{0, 0, -50}, {0.01f, 0, -50}, {0.01f, 0.01f, -50}, {0, 0.01f, -50}}}}),
            grey);
  return scene;
}

// Open to the south, in the frame of x east, y north, z up.
Scene room() {
  Scene scene;
  std::vector<std::array<Point3f, 4>> walls = box_faces({0, 0, 0}, {4, 6, 3});
  std::erase_if(walls, [](const std::array<Point3f, 4>& wall) {
    return std::ranges::all_of(wall, [](const Point3f& p) { return p.y == 0; });
  });
  add_shape(scene, add_quads(scene, walls), grey);
  return scene;
}

class DaylightCoefficients : public testing::Test {
 protected:
  Coefficients trace(Scene scene, const std::string& sensors, DaylightRows rows, int samples, int threads = 0,
                     std::uint32_t domains = 1, bool direct = false) {
    set_camera(scene, {0, -9, 1}, {0, 0, 1}, {0, 0, 1}, 1, 8, 8);
    std::ofstream(directory_ / "sensors.txt") << sensors;
    RenderOptions options;
    options.picture.sensors = directory_ / "sensors.txt";
    options.picture.samples_per_pixel = samples;
    options.picture.max_depth = direct ? 0 : 1 << 20;
    const bool patches = rows.patches.has_value();
    options.picture.daylight = std::move(rows);
    options.resources.threads = threads;
    const Film film = render(scene, std::move(options), domains).film;
    hash_ = film.hash();
    return coefficients_of(film, patches);
  }
  TemporaryDirectory directory_;
  std::uint64_t hash_ = 0;
};

DaylightRows patches(int mf) {
  DaylightRows rows;
  rows.patches.emplace(mf);
  return rows;
}

double sum(std::span<const float> values) {
  double sum = 0;
  for (const float x : values) sum += static_cast<double>(x);
  return sum;
}

// ∫ cos θ dω over a patch, for a sensor that faces up; one that faces a wall has half the sky and half the
// ground.
TEST_F(DaylightCoefficients, OfAnOpenSkyAreThePatchesThemselves) {
  const SkyPatches sky(1);
  const Coefficients c = trace(open_field(), "0 0 0 0 0 1\n0 0 0 0 -1 0\n", patches(1), 2048);
  ASSERT_EQ(c.sensors, 2u);
  ASSERT_EQ(c.lights, 146u);
  EXPECT_EQ(c.of(0)[0], 0);
  EXPECT_NEAR(sum(c.of(0)), pi, 1e-4);
  EXPECT_NEAR(sum(c.of(1)), pi, 1e-4);
  EXPECT_NEAR(c.of(1)[0], pi / 2, 3e-3);
  for (std::size_t p = 1; p < c.lights; ++p) {
    double up = 0, south = 0;
    constexpr int side = 32;
    for (int i = 0; i < side * side; ++i) {
      const Vector3d d = sky.direction(p, (i % side + 0.5) / side, (i / side + 0.5) / side);
      up += d.z * sky.solid_angle(p) / (side * side);
      south += std::max(0.0, -d.y) * sky.solid_angle(p) / (side * side);
    }
    EXPECT_NEAR(c.of(0)[p], up, 0.03 * up + 1e-4) << p;
    EXPECT_NEAR(c.of(1)[p], south, 0.03 * south + 2e-4) << p;
    EXPECT_LT(c.errors_of(0)[p], 0.03 * up + 1e-4) << p;
  }
}

// The frame turns the sky over the scene.
TEST_F(DaylightCoefficients, FollowTheFrameOfTheSky) {
  DaylightRows rows = patches(1);
  rows.sky.x = {0, 0, -1}, rows.sky.y = {1, 0, 0}, rows.sky.z = {0, 1, 0};  // up is y, north is x
  const Coefficients c = trace(open_field(), "0 0 0 0 1 0\n0 0 0 1 0 0\n", std::move(rows), 256);
  EXPECT_EQ(c.of(0)[0], 0);
  EXPECT_NEAR(c.of(1)[0], pi / 2, 0.01);
  EXPECT_NEAR(c.of(1)[1] / SkyPatches(1).solid_angle(1), std::cos(6 * radian), 0.05);  // to the north
  EXPECT_EQ(c.of(1)[16], 0);                                                           // to the south
}

// The cosine, whatever the disc: 0 where the sun is behind the sensor.
TEST_F(DaylightCoefficients, OfSunsAreCosines) {
  DaylightRows rows;
  for (int hour = 0; hour < 4000; ++hour)
    rows.suns.push_back(direction_of({1.0 + hour % 88, 360.0 * hour / 4000}));
  const std::vector<Vector3d> suns = rows.suns;
  const Coefficients c = trace(open_field(), "0 0 0 0 0 1\n0 0 0 0 -1 0\n", std::move(rows), 64);
  ASSERT_EQ(c.lights, suns.size());
  for (std::size_t i = 0; i < suns.size(); ++i) {
    EXPECT_NEAR(c.of(0)[i], suns[i].z, 0.01) << i;
    EXPECT_NEAR(c.of(1)[i], std::max(0.0, -suns[i].y), 0.01) << i;
  }
}

// However finely the sky is divided.
TEST_F(DaylightCoefficients, OfARoomAddUpToTheSame) {
  const Coefficients one = trace(room(), "2 1 .8 0 0 1\n2 5 .8 0 0 1\n", patches(1), 512),
                     four = trace(room(), "2 1 .8 0 0 1\n2 5 .8 0 0 1\n", patches(4), 32);
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_LT(sum(one.of(s)), pi);
    EXPECT_NEAR(sum(one.of(s)) / sum(four.of(s)), 1, 0.02);
    EXPECT_GT(one.of(s)[0], 0);  // the ground by way of the ceiling
  }
}

TEST_F(DaylightCoefficients, AreBeamsAndWhatSurfacesReflect) {
  DaylightRows rows;
  rows.suns = {direction_of({30, 180}), direction_of({30, 0})};
  DaylightRows rest = rows;
  rest.reflected_alone = true;
  const DaylightRows same = rows;
  const std::string sensors = "2 .5 .8 0 0 1\n2 5.5 .8 0 0 1\n";
  const Coefficients all = trace(room(), sensors, std::move(rows), 4096),
                     beams = trace(room(), sensors, same, 64, 0, 1, true),
                     reflected = trace(room(), sensors, std::move(rest), 4096);
  EXPECT_NEAR(beams.of(0)[0], 0.5, 0.01);
  EXPECT_EQ(beams.of(1)[0], 0);  // the sun reaches to y = 2.2 / tan 30° = 3.8
  EXPECT_EQ(beams.of(0)[1], 0);
  EXPECT_GT(reflected.of(0)[0], 0.02);
  EXPECT_LT(reflected.of(0)[0], 0.2);
  EXPECT_NEAR(all.of(0)[0], beams.of(0)[0] + reflected.of(0)[0], 0.01);
  EXPECT_NEAR(all.of(1)[0] / reflected.of(1)[0], 1, 0.05);
  EXPECT_EQ(all.of(1)[1], 0);  // from the north nothing gets in
}

// Whatever threads and sub-domains.
TEST_F(DaylightCoefficients, HaveTheSameBits) {
  const std::string sensors = "2 1 .8 0 0 1\n2 5 .8 0 0 1\n";
  std::uint64_t sky = 0, sun = 0;
  for (const auto& [threads, domains] : {std::pair{1, 1u}, {3, 1u}, {2, 4u}}) {
    trace(room(), sensors, patches(2), 6, threads, domains);
    if (sky == 0) sky = hash_;
    EXPECT_EQ(hash_, sky) << threads << ", " << domains;
    DaylightRows rows;
    for (int hour = 0; hour < 50; ++hour) rows.suns.push_back(direction_of({1.5 * hour, 90 + 3.6 * hour}));
    trace(room(), sensors, std::move(rows), 16, threads, domains);
    if (sun == 0) sun = hash_;
    EXPECT_EQ(hash_, sun) << threads << ", " << domains;
  }
}

}  // namespace
}  // namespace vitrail::test::daylight_coefficients_test
