// SPDX-License-Identifier: Apache-2.0
// What is left of light behind what lets it straight through: sheets, masks and media, one behind the other,
// thin, near the light or far from it, and as many as the depth allows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/support/render.h"

namespace vitrail::test::means_of_connections_test {
namespace {

const Material black{DiffuseMaterial{ConstantSpectrum{0}}};

std::array<Point3f, 4> flat(float half, float z, bool up) {
  std::array<Point3f, 4> q{{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}}};
  if (!up) std::swap(q[1], q[3]);
  return q;
}

enum class Lamp { point, far_point, square, sun };

// A white spot around 0 that faces +z and gets this much of the lamp where nothing is between them.
struct Setting {
  Scene scene;
  double irradiance = 1;

  explicit Setting(Lamp lamp) {
    add_shape(scene, add_quads(scene, {flat(0.01f, 0, true)}),
              Material{DiffuseMaterial{ConstantSpectrum{1}}});
    OrthographicCamera camera;
    camera.camera_to_world = look_at({0, 0, 0.005}, {0, 0, 0}, {0, 1, 0});
    camera.screen = {-1e-4, 1e-4, -1e-4, 1e-4};
    scene.camera = camera;
    scene.film.width = scene.film.height = 8;
    scene.film.crop = {0, 8, 0, 8};
    scene.film.filter = BoxFilter{};
    scene.settings.max_depth = 100;
    if (lamp == Lamp::point) scene.lights.push_back(Light{PointLight{{0, 0, 2}, ConstantSpectrum{4}}, {}});
    if (lamp == Lamp::far_point)
      scene.lights.push_back(Light{PointLight{{0, 0, 1e6}, ConstantSpectrum{1e12f}}, {}});
    if (lamp == Lamp::sun) scene.lights.push_back(Light{DistantLight{{0, 0, -1}, ConstantSpectrum{1}}, {}});
    if (lamp == Lamp::square) {
      add_shape(scene, add_quads(scene, {flat(1, 2, false)}), black, AreaLight{ConstantSpectrum{1}});
      const double x = 0.5, u = std::sqrt(1 + x * x);
      irradiance = 4 * x / u * std::atan(x / u);
    }
  }
  // What is seen over what would be without anything between.
  double passed(int samples = 256) const {
    return brightness(render(scene, samples).film).mean * pi / irradiance;
  }
  Id<Material> add_material(Material material) {
    scene.materials.push_back(std::move(material));
    return {static_cast<std::uint32_t>(scene.materials.size() - 1)};
  }
  void add_sheet(float z, const Material& material) {
    add_shape(scene, add_quads(scene, {flat(50, z, false)}), material);
  }
};

constexpr std::array<Lamp, 4> lamps{Lamp::point, Lamp::far_point, Lamp::square, Lamp::sun};

const char* name(Lamp lamp) {
  return std::array{"a point", "a far point", "a square", "the sun"}[static_cast<std::size_t>(lamp)];
}

Material mask(Setting& setting, float opacity) {
  MaskMaterial m;
  m.material = setting.add_material(black);
  m.opacity = opacity;
  return Material{m};
}

TEST(Connections, ThroughMasks) {
  for (const Lamp lamp : lamps)
    for (const float gap : {0.3f, 1e-3f, 1e-6f})
      for (const int count : {1, 2, 4}) {
        Setting setting(lamp);
        const Material half = mask(setting, 0.5f);
        for (int i = 0; i < count; ++i) setting.add_sheet(0.5f + static_cast<float>(i) * gap, half);
        const double passed = setting.passed(), expected = std::pow(0.5, count);
        fmt::print("{} masks {} apart before {}: {:.5f} of {:.5f}\n", count, gap, name(lamp), passed,
                   expected);
        EXPECT_NEAR(passed / expected, 1, lamp == Lamp::square ? 0.03 : 2e-3);
      }
}

// Of light across them; of the sun with what goes to and fro between them, that of a point comes from
// elsewhere.
TEST(Connections, ThroughSheets) {
  constexpr double r = 0.04, through = 1 - 2 * r / (1 + r);
  for (const Lamp lamp : {Lamp::point, Lamp::far_point, Lamp::sun})
    for (const float gap : {0.3f, 1e-3f, 1e-6f})
      for (const int count : {1, 2, 4}) {
        Setting setting(lamp);
        for (int i = 0; i < count; ++i)
          setting.add_sheet(0.5f + static_cast<float>(i) * gap, Material{ThinDielectricMaterial{}});
        const double expected =
            lamp == Lamp::sun ? (1 - r) / (1 + (2 * count - 1) * r) : std::pow(through, count);
        EXPECT_NEAR(setting.passed() / expected, 1, 2e-3)
            << count << " sheets " << gap << " apart before " << name(lamp);
      }
}

// A slab that absorbs, between two surfaces that are nothing else.
TEST(Connections, ThroughMedia) {
  for (const Lamp lamp : lamps)
    for (const double optical_depth : {0.1, 1.0, 4.0})
      for (const float thickness : {1.0f, 1e-3f}) {
        Setting setting(lamp);
        Medium medium;
        AbsorptionScattering k;
        k.sigma_a =
            Spectrum{ConstantSpectrum{static_cast<float>(optical_depth / static_cast<double>(thickness))}};
        k.sigma_s = Spectrum{ConstantSpectrum{0}};
        medium.coefficients = k;
        setting.scene.media.push_back(medium);
        add_shape(setting.scene,
                  add_quads(setting.scene, box_faces({-50, -50, 0.5f}, {50, 50, 0.5f + thickness})),
                  Material{InterfaceMaterial{}});
        setting.scene.shapes.back().interior = Id<Medium>{0};
        double expected = std::exp(-optical_depth);
        if (lamp == Lamp::square) {  // by ∫ e^(−τ/cosθ) cosθ dω over the lamp, over its irradiance
          double sum = 0;
          constexpr int steps = 400;
          for (int x = 0; x < steps; ++x)
            for (int y = 0; y < steps; ++y) {
              const double px = 2 * (x + 0.5) / steps - 1, py = 2 * (y + 0.5) / steps - 1;
              const double r2 = px * px + py * py + 4, cosine = 2 / std::sqrt(r2);
              sum += std::exp(-optical_depth / cosine) * cosine * cosine / r2 * 4 / (steps * steps);
            }
          expected = sum / setting.irradiance;
        }
        EXPECT_NEAR(setting.passed() / expected, 1, lamp == Lamp::square ? 0.02 : 5e-3)
            << name(lamp) << ", depth " << optical_depth << ", " << thickness << " thick";
      }
}

// A connection ends where a path would: each sheet is an event, but for scenes that do not count them.
TEST(Connections, AsDeepAsPaths) {
  for (const Lamp lamp : {Lamp::point, Lamp::square})
    for (const bool counts : {false, true})
      for (const int depth : {1, 3, 4, 5}) {
        Setting setting(lamp);
        const Material half = mask(setting, 0.5f);
        for (int i = 0; i < 3; ++i) setting.add_sheet(0.5f + 0.1f * static_cast<float>(i), half);
        setting.scene.settings.max_depth = depth;
        setting.scene.settings.straight_counts = counts;
        const double expected = counts && depth < 4 ? 0 : 0.125;
        EXPECT_NEAR(setting.passed(), expected, lamp == Lamp::square ? 0.005 : 5e-4)
            << name(lamp) << ", depth " << depth << (counts ? ", counted" : "");
      }
}

}  // namespace
}  // namespace vitrail::test::means_of_connections_test
