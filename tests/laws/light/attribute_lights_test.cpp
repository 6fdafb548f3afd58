// SPDX-License-Identifier: Apache-2.0
// Lamps whose radiance is an attribute of their mesh, alone or among other textures: the mean, and the noise
// of a lamp that is sampled.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/support/render.h"

namespace vitrail::test::attribute_lights_test {
namespace {

struct Seen {
  double mean = 0, scatter = 0;  // standard deviation of the pixels over their mean
};

// A square lamp `half` wide at the height 3 above a white spot. Its attribute is `left` at its left edge and
// `right` at its right one; `radiance` makes of the attribute's texture what shines.
template <class Radiance>
Seen seen(float half, float left, float right, const Radiance& radiance, bool mirrored = false) {
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{1}}});
  const auto lamp =
      add_quads(scene, {{{{-half, -half, 3}, {-half, half, 3}, {half, half, 3}, {half, -half, 3}}}});
  MeshAttribute attribute;
  attribute.name = "vertex_glow";
  for (const float v : {left, left, right, right}) attribute.values.insert(attribute.values.end(), {v, v, v});
  scene.meshes[lamp.value].attributes.push_back(attribute);
  scene.textures.push_back({MeshAttributeTexture{"vertex_glow"}, false, "", {}});
  AreaLight light;
  light.radiance = radiance(scene);
  light.two_sided = mirrored;
  add_shape(scene, lamp, Material{DiffuseMaterial{ConstantSpectrum{0}}}, light);
  if (mirrored) scene.shapes.back().object_to_world = scale({-1, 1, 1});
  OrthographicCamera camera;
  camera.camera_to_world = look_at({0, 0, 0.5}, {0, 0, 0}, {0, 1, 0});
  camera.screen = {-0.01, 0.01, -0.01, 0.01};
  scene.camera = camera;
  scene.film.width = scene.film.height = 8;
  scene.film.crop = {0, 8, 0, 8};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 1;
  const Film film = render(scene, 1024).film;
  Seen result;
  double squares = 0;
  for (std::uint32_t i = 0; i < 64; ++i) {
    result.mean += film.mean(i).y / 64;
    squares += film.mean(i).y * film.mean(i).y / 64;
  }
  result.scatter = std::sqrt(std::max(0.0, squares - result.mean * result.mean)) / result.mean;
  fmt::print("half width {}, {} to {}: {:.6g}, scatter {:.4f}\n", half, left, right, result.mean,
             result.scatter);
  return result;
}

SpectrumParameter alone(Scene&) { return Id<Texture>{0}; }
SpectrumParameter times_half(Scene& scene) {
  scene.textures.push_back({ProductTexture{Id<Texture>{0}, ConstantSpectrum{0.5f}}, false, "", {}});
  return Id<Texture>{1};
}
SpectrumParameter half_of_one(Scene& scene) {
  scene.textures.push_back(
      {MixTexture{Id<Texture>{0}, Spectrum{emission_from_rgb({1, 1, 1})}, 0.5f}, false, "", {}});
  return Id<Texture>{1};
}

// The spot is below the middle: a ramp gives it as much as its mean.
TEST(AttributeLights, HaveTheMeanOfTheirAttribute) {
  for (const float half : {3.0f, 0.1f}) {
    const double one = seen(half, 1, 1, alone).mean;
    const double tolerance = half > 1 ? 0.01 : 0.005;
    EXPECT_NEAR(seen(half, 0, 1, alone).mean / one, 0.5, tolerance);
    EXPECT_NEAR(seen(half, 0, 1, alone, true).mean / one, 0.5, tolerance);
    EXPECT_NEAR(seen(half, 0, 1, times_half).mean / one, 0.25, tolerance);
    EXPECT_NEAR(seen(half, 0, 1, half_of_one).mean / one, 0.75, tolerance);
    EXPECT_NEAR(seen(half, 1, 0, half_of_one).mean / one, 0.75, tolerance);
  }
}

TEST(AttributeLights, AreSampled) {
  EXPECT_LT(seen(0.1f, 1, 1, alone).scatter, 0.02);
  EXPECT_LT(seen(0.1f, 0, 1, times_half).scatter, 0.05);
  EXPECT_LT(seen(0.1f, 0, 1, half_of_one).scatter, 0.05);
}

}  // namespace
}  // namespace vitrail::test::attribute_lights_test
