// SPDX-License-Identifier: Apache-2.0
// Lights whose image has one bright spot, in pictures: what a floor gets of them, by paths, by direct light
// and by photons, against the closed form of a spot that is small.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "images/image_files.h"
#include "scene/geometry/portable_math.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::means_of_images_test {
namespace {

constexpr int side = 48;

// White of `value` in the texels [x, x + 2) × [y, y + 2), y from the top.
Id<Texture> spot_image(Scene& scene, const std::filesystem::path& file, int x, int y, float value) {
  Image image{side, side, 3, std::vector<float>(3 * side * side, 0.0f)};
  for (int k = 0; k < 12; ++k)
    image.values[static_cast<std::size_t>(3 * ((y + k / 6) * side + x + k / 3 % 2) + k % 3)] = value;
  write_exr_image(file, image);
  ImageTexture texture;
  texture.filename = file.string();
  texture.wrap = Wrap::clamp;
  scene.textures.push_back({texture, false, "", {}});
  return Id<Texture>{static_cast<std::uint32_t>(scene.textures.size() - 1)};
}

void expect_means(const Scene& scene, double expected, const char* what) {
  struct Way {
    const char* name;
    Integrator integrator;
    std::uint64_t photons;
    double tolerance;
  };
  for (const Way way : {Way{"path", Integrator::path, 0, 0.02}, Way{"direct", Integrator::direct, 0, 0.02},
                        Way{"photon", Integrator::photon, 20000, 0.06}}) {
    RenderOptions options;
    options.picture.samples_per_pixel = way.photons > 0 ? 32 : 256;
    options.picture.integrator = way.integrator;
    if (way.photons > 0) options.picture.photons = {way.photons, 0.2, 2.0 / 3};
    const Brightness seen = brightness(render(scene, std::move(options)).film);
    fmt::print("{}, {}: {:.5g} ± {:.2g} of {:.5g}\n", what, way.name, seen.mean, seen.standard_error,
               expected);
    EXPECT_NEAR(seen.mean, expected, 4 * seen.standard_error + way.tolerance * expected) << what << way.name;
  }
}

Scene floor() {
  Scene scene;
  add_shape(scene, square(scene, 0, 2), Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  OrthographicCamera camera;  // below the lamp
  camera.camera_to_world = look_at({0, 0, 1}, {0, 0, 0}, {0, 1, 0});
  camera.screen = {-0.3, 0.3, -0.3, 0.3};
  scene.camera = camera;
  scene.film.width = scene.film.height = 16;
  scene.film.crop = {0, 16, 0, 16};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 1;
  return scene;
}

// All of what falls on the floor is in sight: E = Φ / A.
TEST(MeansOfImages, Projection) {
  const TemporaryDirectory directory;
  for (const auto& [x, y] : {std::array{0, 0}, std::array{21, 26}, std::array{46, 46}}) {
    Scene scene = floor();
    ProjectionLight light;
    light.image = spot_image(scene, directory / fmt::format("{}.exr", x), x, y, 100);
    light.fov_deg = 11;
    light.power = 7.0f;
    light.light_to_world = translate({0, 0, 3}) * rotate(pi, {1, 0, 0});
    scene.lights.push_back({light, {}});
    expect_means(scene, 7 / (0.6 * 0.6) * 0.5 / pi, "projection");
  }
}

TEST(MeansOfImages, Lamps) {
  const TemporaryDirectory directory;
  for (const float opacity : {1.0f, 0.0f})
    for (const auto& [x, y] : {std::array{3, 30}, std::array{46, 0}}) {
      Scene scene = floor();
      scene.area_lights.clear();
      const float h = 3;
      const auto lamp = add_quads(scene, {{{{-1, -1, h}, {-1, 1, h}, {1, 1, h}, {1, -1, h}}}});
      scene.meshes[lamp.value].uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
      AreaLight light;
      light.radiance = spot_image(scene, directory / fmt::format("{}.exr", x), x, y, 100);
      add_shape(scene, lamp, Material{DiffuseMaterial{ConstantSpectrum{0}}}, light);
      scene.shapes.back().opacity = opacity;
      double expected = 0;
      const double px = 2 * (x + 1.0) / side - 1, py = 1 - 2 * (y + 1.0) / side,
                   area = std::pow(4.0 / side, 2);
      constexpr int n = 50;
      for (int i = 0; i < n * n; ++i) {
        const double dx = 0.6 * ((i % n + 0.5) / n - 0.5) - px, dy = 0.6 * ((i / n + 0.5) / n - 0.5) - py;
        expected += 100 * area * 9 / std::pow(dx * dx + dy * dy + 9, 2) * 0.5 / pi / (n * n);
      }
      expect_means(scene, expected, opacity > 0 ? "a lamp" : "a lamp that nothing meets");
    }
}

}  // namespace
}  // namespace vitrail::test::means_of_images_test
