// SPDX-License-Identifier: Apache-2.0
// Numbers below 1.2·10⁻³⁸, that floats hold with fewer bits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/extremes/measure.h"

namespace vitrail::test::denormals_test {
namespace {

Scene still_life(double size) {
  Scene scene;
  add_shape(scene, add_quads(scene, {square_at(-1, 2)}), matte(0.6f));
  add_shape(scene, add_quads(scene, box_faces({-0.75f, -0.5f, -0.5f}, {0, 0.25f, 0.25f})),
            Material{DielectricMaterial{ConstantSpectrum{1.5f}}});
  add_shape(scene, add_quads(scene, box_faces({0.25f, -0.5f, -0.9f}, {0.75f, 0.5f, 0.25f})), matte(0.3f));
  for (Shape& shape : scene.shapes) shape.object_to_world = scale({size, size, size});
  add_sky(scene, 1);
  const auto placed = [&](Point3d p) { return Point3d{} + (p - Point3d{}) * size; };
  set_camera(scene, placed({0.5, -3, 0.75}), placed({0, 0, -0.375}), {0, 0, 1}, 0.9, 32, 32);
  return scene;
}

// At 10⁻⁴⁰ floats are 1.4·10⁻⁴⁵ apart: 10⁻⁵ of the scene.
TEST(Denormals, ASceneOfDenormals) {
  const Film usual = render_finite(still_life(1), 64).film;
  for (const double size : {1e-30, 1e-36, 1e-38, 1e-40}) {
    const Film film = render_finite(still_life(size), 64, fmt::format("denormal_{:g}", size)).film;
    const FilmDifference d = picture_difference(usual, film);
    expect_absolute(fmt::format("a scene of {:g}: mean of the picture, relative", size), 0, d.mean, 2e-3);
    expect_absolute(fmt::format("a scene of {:g}: pixels, r.m.s., relative", size), 0, d.root_mean_square,
                    2e-2);
  }
}

// A coordinate of 10⁻⁴² in place of 0 moves nothing.
TEST(Denormals, AmongOtherCoordinates) {
  const auto picture = [](float zero) {
    Scene scene;
    add_shape(scene,
              add_quads(scene, {{{{-2, zero, zero}, {2, zero, zero}, {2, 2, zero}, {-2, 2, -zero}}},
                                {{{-2, -2, -zero}, {2, -2, zero}, {2, zero, zero}, {-2, zero, zero}}}}),
              matte(0.6f));
    add_shape(scene, add_quads(scene, box_faces({-1, zero, zero}, {1, 1, 1})), matte(0.3f));
    add_sky(scene, 1);
    add_sun(scene, {1e-40, -1, -1}, 1);
    set_camera(scene, {0.5, -3, 2}, {0, 0, 0}, {0, 0, 1}, 0.9, 32, 32);
    return render_finite(scene, 16).film;
  };
  const Film without = picture(0);
  for (const float zero : {1e-42f, -1e-42f, 1.4e-45f})
    expect_absolute(fmt::format("coordinates of {:g} in place of 0: r.m.s., relative", zero), 0,
                    picture_difference(without, picture(zero)).root_mean_square, 1e-6);
}

TEST(Denormals, Radiance) {
  for (const double radiance : {1e-38, 1e-40, 1.4e-45}) {
    Scene scene = still_life(1);
    scene.lights.clear();
    add_sky(scene, radiance);
    add_shape(scene, add_quads(scene, {square_at(2, 1)}), matte(0), lamp(radiance, true));
    expect_absolute(fmt::format("lights of {:g}: mean of the picture", radiance), 0, measure(scene, 4).mean,
                    1e-37);
  }
}

// Beside a bright one they change nothing.
TEST(Denormals, RadianceBesideAnother) {
  const auto picture = [](double radiance) {
    Scene scene = still_life(1);
    if (radiance > 0)
      add_shape(scene, add_quads(scene, {square_at(2, 1)}), matte(0), lamp(radiance, true));
    else
      add_shape(scene, add_quads(scene, {square_at(2, 1)}), matte(0));
    return render_finite(scene, 64).film;
  };
  const FilmDifference d = picture_difference(picture(0), picture(1e-40));
  expect_absolute("a lamp of 10⁻⁴⁰ beside a sky of 1: mean, relative", 0, d.mean, 2e-3);
}

// A haze without end that is too thin to scatter within the scene hides nothing.
TEST(Denormals, HazeWithoutEnd) {
  const Film without = render_finite(still_life(1), 16).film;
  for (const float sigma : {1e-12f, 1e-18f, 1e-30f, 1e-40f, 1e-44f}) {
    Scene scene = still_life(1);
    Medium medium;
    medium.coefficients =
        AbsorptionScattering{Spectrum{ConstantSpectrum{0}}, Spectrum{ConstantSpectrum{sigma}}};
    scene.media.push_back(medium);
    scene.camera_medium = Id<Medium>{0};
    for (Shape& shape : scene.shapes) shape.exterior = Id<Medium>{0};
    expect_absolute(fmt::format("a haze of {:g} without end: mean of the picture, relative", sigma), 0,
                    picture_difference(without, render_finite(scene, 16).film).mean, 1e-3);
  }
}

TEST(Denormals, Media) {
  Scene scene = still_life(1);
  const Film without = render_finite(scene, 16).film;
  for (const float sigma : {1e-40f, 1e-44f}) {
    Scene foggy = still_life(1);
    Medium medium;
    medium.coefficients =
        AbsorptionScattering{Spectrum{ConstantSpectrum{sigma}}, Spectrum{ConstantSpectrum{sigma}}};
    foggy.media.push_back(medium);
    foggy.camera_medium = Id<Medium>{0};
    for (Shape& shape : foggy.shapes) shape.exterior = Id<Medium>{0};
    add_shape(foggy, add_quads(foggy, box_faces({-5, -5, -5}, {5, 5, 5})), Material{InterfaceMaterial{}});
    foggy.shapes.back().interior = Id<Medium>{0};
    expect_absolute(fmt::format("a haze of {:g}: mean of the picture, relative", sigma), 0,
                    picture_difference(without, render_finite(foggy, 16).film).mean, 1e-3);
  }
}

}  // namespace
}  // namespace vitrail::test::denormals_test
