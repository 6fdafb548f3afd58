// SPDX-License-Identifier: Apache-2.0
// The darkest and the brightest lights, together and alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/extremes/measure.h"

namespace vitrail::test::radiances_test {
namespace {

constexpr double radiances[] = {1e-30, 1e-10, 1e-4, 1, 1e4, 1e7, 1e20, 1e30};

// A lamp over a floor: seen, and by its light. One corner's configuration factor (Howell, Menguc & Daun,
// B-4).
TEST(Radiance, OfALampAndOfWhatItLights) {
  for (const double radiance : radiances) {
    Scene scene;
    add_shape(scene, add_quads(scene, {square_at(0, 10)}), matte(0.5f));
    add_shape(scene, add_quads(scene, {{{{-1, -1, 1.5f}, {-1, 1, 1.5f}, {1, 1, 1.5f}, {1, -1, 1.5f}}}}),
              matte(0), lamp(radiance));
    scene.settings.max_depth = 1;
    set_camera(scene, {0, 0, 0.75}, {0, 0, 1}, {0, 1, 0}, 0.02, 8, 8);
    expect_relative(fmt::format("a lamp of {:g}", radiance), radiance, measure(scene, 16).mean, 2e-5);
    set_camera(scene, {0, 0, 0.75}, {0, 0, 0}, {0, 1, 0}, 0.02, 8, 8);
    const double a = 1 / 1.5, r = std::sqrt(1 + a * a),
                 factor = 4 * (a / r * std::atan(a / r) * 2) / (2 * pi);
    const Measured b = measure(scene, 256);
    expect_relative(fmt::format("a floor of .5 under it"), 0.5 * factor * radiance, b.mean, 2e-4,
                    b.standard_error);
  }
}

// The sun's irradiance is a million times the sky's.
Scene under_sun_and_sky(bool sun_is_a_disk) {
  Scene scene;
  add_shape(scene, add_quads(scene, {square_at(0, 10)}), matte(0.5f));
  add_sky(scene, 1);
  constexpr double sun = 1e6 * pi;
  if (sun_is_a_disk) {  // a square of 4.65·10⁻³ rad straight above
    constexpr float height = 1000, half = 4.65f / 2;
    add_shape(
        scene,
        add_quads(
            scene,
            {{{{-half, -half, height}, {-half, half, height}, {half, half, height}, {half, -half, height}}}}),
        matte(0), lamp(sun / (4.65e-3 * 4.65e-3)));
  } else {
    add_sun(scene, {0, 0, -1}, sun);
  }
  scene.settings.max_depth = 1;
  return scene;
}

// A square of Ω = (4.65e-3)² straight above gives E = L·Ω up to Ω.
TEST(Sun, AMillionTimesTheSky) {
  for (const bool disk : {false, true}) {
    Scene scene = under_sun_and_sky(disk);
    set_camera(scene, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.02, 16, 16);
    const Measured b = measure(scene, 64);
    expect_relative(fmt::format("sun ({}) and sky on the ground", disk ? "square" : "distant"),
                    0.5 * (1e6 + 1), b.mean, 5e-5, b.standard_error);
  }
}

// In its shadow there is the sky alone, as far as the roof lets see of it: a square of half width 2, 0.5
// above.
TEST(Sun, LeavesItsShadowToTheSky) {
  for (const bool disk : {false, true}) {
    Scene scene = under_sun_and_sky(disk);
    add_shape(scene, add_quads(scene, {square_at(0.5f, 2)}), matte(0));
    set_camera(scene, {0, 0, 0.25}, {0, 0, 0}, {0, 1, 0}, 0.02, 16, 16);
    const double a = 2 / 0.5, r = std::sqrt(1 + a * a), roof = 4 * (a / r * std::atan(a / r) * 2) / (2 * pi);
    const Measured b = measure(scene, 1024);
    expect_relative(fmt::format("shadow of a sun ({}) a million times the sky", disk ? "square" : "distant"),
                    0.5 * (1 - roof), b.mean, 2e-4, b.standard_error);
  }
}

}  // namespace
}  // namespace vitrail::test::radiances_test
