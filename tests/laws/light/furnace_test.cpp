// SPDX-License-Identifier: Apache-2.0
// Scenes whose picture is known in closed form.
#include <gtest/gtest.h>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/color.h"
#include "scene/spectra/named_spectra.h"
#include "tests/support/render.h"

namespace vitrail::test::furnace_test {
namespace {

// A box seen from inside whose walls all emit 1 and reflect ρ: radiance Σ ρᵏ for k = 0 … depth.
double closed_box(double albedo, int depth, double* expected, double* standard_error) {
  Scene scene;
  auto faces = box_faces({-1, -1, -1}, {1, 1, 1});
  for (auto& face : faces) std::swap(face[1], face[3]);  // fronts inwards
  add_shape(scene, add_quads(scene, faces),
            Material{DiffuseMaterial{ConstantSpectrum{static_cast<float>(albedo)}}},
            AreaLight{ConstantSpectrum{1}, false});
  set_camera(scene, {0.1, 0.2, -0.3}, {0.4, 0, 1}, {0, 1, 0}, 1.2, 16, 16);
  scene.settings.max_depth = depth;
  const Rendered rendered = render(scene, 256);
  EXPECT_EQ(rendered.stats.refused, Refused{});
  *expected = 0;
  for (int k = depth; k >= 0; --k) *expected = 1 + albedo * *expected;
  const Brightness result = brightness(rendered.film);
  *standard_error = result.standard_error;
  return result.mean;
}

TEST(WhiteFurnace, ClosedBoxOfAlbedoHalf) {
  double expected = 0, error = 0;
  const double mean = closed_box(0.5, 30, &expected, &error);
  EXPECT_NEAR(expected, 2, 1e-8);
  EXPECT_NEAR(mean, expected, 4 * error + 1e-6);
  EXPECT_LT(error, 0.005 * expected);
}

TEST(WhiteFurnace, ClosedBoxOfAlbedoOne) {
  double expected = 0, error = 0;
  const double mean = closed_box(1, 12, &expected, &error);
  EXPECT_EQ(expected, 13);
  EXPECT_NEAR(mean, expected, 4 * error + 1e-6);
  EXPECT_LT(error, 0.005 * expected);
}

// A white object under a uniform sky cannot be seen, whether it scatters or refracts. Depth is bounded, so a
// little of the light that stays in the glass is missing.
TEST(WhiteFurnace, ObjectsVanishUnderAUniformSky) {
  HairMaterial fibre;  // met from outside alone, the ends of the box too
  fibre.sigma_a = ConstantSpectrum{0};
  const Material materials[] = {Material{fibre}, Material{DiffuseMaterial{ConstantSpectrum{1}}},
                                Material{DielectricMaterial{ConstantSpectrum{1.5f}}},
                                Material{DielectricMaterial{bk7()}}};
  for (const Material& material : materials) {
    Scene scene;
    add_shape(scene, add_quads(scene, box_faces({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f})), material);
    scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}});
    set_camera(scene, {1.3, 1.7, -2}, {0, 0, 0}, {0, 1, 0}, 0.5, 16, 16);
    scene.settings.max_depth = 100;
    const Brightness result = brightness(render(scene, 256).film);
    EXPECT_NEAR(result.mean, 1, 4 * result.standard_error + 1e-4) << material.model.index();
  }
}

// E = I cosθ/d²; a Lambertian plane reflects L = ρE/π.
TEST(PointLight, OnAPlane) {
  Scene scene;
  constexpr float albedo = 0.6f;
  add_shape(scene, add_quads(scene, {{{{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{albedo}}});
  scene.lights.push_back(Light{PointLight{{0.5, 0.25, 2}, ConstantSpectrum{7}}});
  set_camera(scene, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.02, 8, 8);
  const Film film = render(scene, 64).film;
  const double d2 = 0.25 + 0.0625 + 4, expected = albedo / pi * 7 * (2 / std::sqrt(d2)) / d2;
  const Brightness result = brightness(film);
  EXPECT_NEAR(result.mean, expected, 4 * result.standard_error + 2e-4 * expected);
}

// A square light of radiance 1 seen from a point of a parallel plane: the configuration factor of a rectangle
// over a point under its corner (Howell, Menguc & Daun, catalogue B-4), four corners together.
TEST(AreaLight, SquareOverAPlane) {
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  add_shape(scene, add_quads(scene, {{{{-1, -1, 1.5f}, {-1, 1, 1.5f}, {1, 1, 1.5f}, {1, -1, 1.5f}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{1}, false});
  set_camera(scene, {0, 0, 0.75}, {0, 0, 0}, {0, 1, 0}, 0.02, 8, 8);
  scene.settings.max_depth = 1;
  const double a = 1 / 1.5, r = std::sqrt(1 + a * a);
  const double corner = (a / r * std::atan(a / r) * 2) / (2 * pi);
  const Brightness result = brightness(render(scene, 1024).film);
  EXPECT_NEAR(result.mean, 0.5 * 4 * corner, 4 * result.standard_error + 2e-4);
  EXPECT_LT(result.standard_error, 0.01 * result.mean);
}

// Sunlight through a pane of parallel faces keeps its direction and loses what the two faces reflect, s and p
// each by itself.
TEST(DistantLight, ThroughAPane) {
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  add_shape(scene, add_quads(scene, box_faces({-10, -10, 1}, {10, 10, 1.006f})),
            Material{DielectricMaterial{ConstantSpectrum{1.5f}}});
  const Vector3d direction = normalize(Vector3d{0.3, 0.2, -1});
  scene.lights.push_back(Light{DistantLight{direction, ConstantSpectrum{3}}});
  set_camera(scene, {0, 0, 0.5}, {0, 0, 0}, {0, 1, 0}, 0.1, 8, 8);
  scene.settings.max_depth = 1;
  const double cosine = -direction.z, sine = std::sqrt(1 - cosine * cosine);
  const double inside = std::sqrt(1 - sine * sine / 2.25);
  const double s = (cosine - 1.5 * inside) / (cosine + 1.5 * inside);
  const double p = (1.5 * cosine - inside) / (1.5 * cosine + inside);
  const double transmitted = ((1 - s * s) / (1 + s * s) + (1 - p * p) / (1 + p * p)) / 2;
  const double expected = 0.5 / pi * 3 * cosine * transmitted;
  const Brightness result = brightness(render(scene, 64).film);
  EXPECT_NEAR(result.mean, expected, 1e-3 * expected + 4 * result.standard_error);
}

// A pane of dispersive glass disperses nothing: every sample keeps its four wavelengths, so the colour of a
// sky seen through it is as smooth as without. With one wavelength a sample the scatter of Z would be ten
// times this.
TEST(Pane, KeepsAllWavelengths) {
  Scene scene;
  add_shape(scene, add_quads(scene, box_faces({-10, -10, 1}, {10, 10, 1.006f})),
            Material{DielectricMaterial{bk7()}});
  scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}});
  set_camera(scene, {0, 0, 0}, {0.3, 0.2, 1}, {0, 1, 0}, 0.1, 16, 16);
  scene.settings.max_depth = 20;
  const Film film = render(scene, 4).film;
  const XYZ expected = to_xyz(ConstantSpectrum{1});
  double mean = 0, scatter = 0;
  for (std::uint32_t i = 0; i < 256; ++i) {
    const double error = film.mean(i).z - expected.z;
    mean += error / 256;
    scatter += error * error / 256;
  }
  EXPECT_NEAR(mean, 0, 0.02);
  EXPECT_LT(std::sqrt(scatter), 0.15);
}

}  // namespace
}  // namespace vitrail::test::furnace_test
