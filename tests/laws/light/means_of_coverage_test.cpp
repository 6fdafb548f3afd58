// SPDX-License-Identifier: Apache-2.0
// What a shape's opacity leaves of it: where it is not there a ray goes on as if it had met nothing, which
// counts for no depth, and what is not there does not shine. A light of which nothing is there shines in
// full.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/long_tests.h"
#include "tracer/bsdf/local.h"

namespace vitrail::test::means_of_coverage_test {
namespace {

const Material black{DiffuseMaterial{ConstantSpectrum{0}}}, white{DiffuseMaterial{ConstantSpectrum{1}}};
const AreaLight one{ConstantSpectrum{1}};

void add_covered(Scene& scene, Id<TriangleMesh> mesh, const Material& material, const FloatParameter& opacity,
                 const std::optional<AreaLight>& light = std::nullopt) {
  add_shape(scene, mesh, material, light);
  scene.shapes.back().opacity = opacity;
}

// A square of half width 1 around (0, 0, z) that faces down.
Id<TriangleMesh> lamp_mesh(Scene& scene, float z) {
  const Id<TriangleMesh> mesh = add_quads(scene, {{{{-1, -1, z}, {-1, 1, z}, {1, 1, z}, {1, -1, z}}}});
  scene.meshes[mesh.value].uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  return mesh;
}

// Irradiance below its middle, of radiance 1.
double lamp_irradiance(double z) {
  const double x = 1 / z, u = std::sqrt(1 + x * x);
  return 4 * x / u * std::atan(x / u);
}

// 1 where u < ½, else 0.
Id<Texture> left_half(Scene& scene) {
  CheckerboardTexture cells{Spectrum{ConstantSpectrum{1}}, Spectrum{ConstantSpectrum{0}}};
  cells.mapping = UvMapping{2, 0, 0, 0, 0, 0.5};
  scene.textures.push_back({cells, true, "", {}});
  return {static_cast<std::uint32_t>(scene.textures.size() - 1)};
}

Mean seen_from(Scene& scene, double theta_deg, int depth, int samples = 256) {
  look_along(scene, direction(theta_deg, 20), {}, 0.01);
  scene.settings.max_depth = depth;
  return mean_of(render(scene, of_all(samples, samples / 2)).film);
}

TEST(Coverage, CountsForNoDepth) {
  for (const bool counts : {false, true}) {
    Scene scene;
    add_shape(scene, square(scene, -1), black, one);
    for (int i = 0; i < 6; ++i) add_covered(scene, square(scene, 0.1f * static_cast<float>(i)), black, 0.5f);
    scene.settings.straight_counts = counts;
    expect_luminance(seen_from(scene, 30, 0, 1024), std::pow(0.5, 6), 0.05, "six cards at depth 0");
    for (Shape& shape : scene.shapes)
      if (!shape.area_light) shape.opacity = 0.0f;
    expect_luminance(seen_from(scene, 30, 0), 1, 1e-3, "six that are not there");
  }
}

TEST(Coverage, OfEmittersSeen) {
  for (const float opacity : {0.0f, 0.3f, 1.0f}) {
    Scene scene;
    scene.lights.push_back({InfiniteLight{ConstantSpectrum{0.2f}}, {}});
    add_covered(scene, square(scene, 0), black, opacity, one);
    const double share = static_cast<double>(opacity);
    expect_luminance(seen_from(scene, 40, 1, 512), share + 0.2 * (1 - share), 0.02,
                     fmt::format("opacity {}", opacity));
  }
}

// Near and far, so that now the light's samples count and now the surface's.
TEST(Coverage, OfEmittersThatLight) {
  for (const float z : {0.1f, 1.0f, 5.0f})
    for (const float opacity : {0.0f, 0.3f, 1.0f}) {
      Scene scene;
      add_shape(scene, square(scene, 0, 8), white);
      add_covered(scene, lamp_mesh(scene, z), black, opacity, one);
      // Nothing meets a light of which nothing is there, and it shines in full.
      const double share = opacity == 0 ? 1 : static_cast<double>(opacity);
      OrthographicCamera camera;
      camera.camera_to_world = look_at({0, 0, 0.05}, {0, 0, 0}, {0, 1, 0});
      camera.screen = {-1e-3, 1e-3, -1e-3, 1e-3};
      look_along(scene, direction(0));
      scene.camera = camera;
      scene.settings.max_depth = 1;
      const Mean found = mean_of(render(scene, of_all(1024, 512)).film);
      expect_luminance(found, share * lamp_irradiance(static_cast<double>(z)) / pi,
                       opacity == 0 && z < 0.5f ? 0.03 : 0.01, fmt::format("opacity {} at {}", opacity, z));
    }
}

TEST(Coverage, ByATextureOfTheEmitter) {
  for (const bool textured : {true, false}) {
    Scene scene;
    add_shape(scene, square(scene, 0, 8), white);
    const Id<TriangleMesh> whole = lamp_mesh(scene, 1);
    if (textured) {
      add_covered(scene, whole, black, left_half(scene), one);
    } else {  // of the same size as the part that is there
      add_shape(scene, add_quads(scene, {{{{-1, -1, 1}, {-1, 1, 1}, {0, 1, 1}, {0, -1, 1}}}}), black, one);
    }
    look_along(scene, direction(75), {0, 0, 0}, 0.001);
    scene.settings.max_depth = 1;
    const Mean found = mean_of(render(scene, of_all(512, 256)).film);
    expect_luminance(found, lamp_irradiance(1) / 2 / pi, 0.01, textured ? "textured" : "half");
  }
}

enum class Lamp { point, square, sun };

// A white spot around 0 that gets `irradiance` of the lamp where nothing is between them.
struct Setting {
  Scene scene;
  double irradiance = 1;

  explicit Setting(Lamp lamp) {
    add_shape(scene, square(scene, 0, 0.01f), white);
    if (lamp == Lamp::point) scene.lights.push_back({PointLight{{0, 0, 2}, ConstantSpectrum{4}}, {}});
    if (lamp == Lamp::sun) scene.lights.push_back({DistantLight{{0, 0, -1}, ConstantSpectrum{1}}, {}});
    if (lamp == Lamp::square) {
      add_shape(scene, lamp_mesh(scene, 2), black, one);
      irradiance = lamp_irradiance(2);
    }
  }
  // What is seen over what would be without anything between.
  double passed(int depth, int samples = 256) {
    look_along(scene, direction(0));
    OrthographicCamera camera;
    camera.camera_to_world = look_at({0, 0, 0.005}, {0, 0, 0}, {0, 1, 0});
    camera.screen = {-1e-4, 1e-4, -1e-4, 1e-4};
    scene.camera = camera;
    scene.settings.max_depth = depth;
    return brightness(render(scene, samples).film).mean * pi / irradiance;
  }
};

TEST(Coverage, InTheWayOfLight) {
  for (const Lamp lamp : {Lamp::point, Lamp::square, Lamp::sun})
    for (const int count : {1, 4}) {
      Setting setting(lamp);
      for (int i = 0; i < count; ++i)
        add_covered(setting.scene, square(setting.scene, 0.5f + 0.1f * static_cast<float>(i), 50), black,
                    0.5f);
      EXPECT_NEAR(setting.passed(1) / std::pow(0.5, count), 1, lamp == Lamp::square ? 0.03 : 1e-3)
          << count << " cards before lamp " << static_cast<int>(lamp);
    }
}

// Where what is there passes light as well, that part alone is an event.
TEST(Coverage, OfSheetsInTheWayOfLight) {
  constexpr double r = 0.04, through = 1 - 2 * r / (1 + r), opacity = 0.6;
  for (const int depth : {1, 3}) {
    Setting setting(Lamp::point);
    for (int i = 0; i < 2; ++i)
      add_covered(setting.scene, square(setting.scene, 0.5f + 0.3f * static_cast<float>(i), 50),
                  Material{ThinDielectricMaterial{}}, static_cast<float>(opacity));
    const double hole = 1 - opacity,
                 expected = depth == 1 ? hole * hole : std::pow(hole + opacity * through, 2);
    // Without what goes to and fro between them.
    EXPECT_NEAR(setting.passed(depth, 4096) / expected, 1, depth == 1 ? 0.03 : 0.02) << "depth " << depth;
  }
}

// A pane of which a part is missing: the sun comes through the holes as it is, through the rest refracted.
TEST(Coverage, OfPanesInTheSun) {
  constexpr double face = 0.96, opacity = 0.5;
  Setting setting(Lamp::sun);
  for (const bool up : {false, true}) {
    const float z = up ? 0.6f : 0.5f;
    const auto quad = [&](float h) {
      std::array<Point3f, 4> q{{{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}}};
      if (!up) std::swap(q[1], q[3]);
      return q;
    };
    add_covered(setting.scene, add_quads(setting.scene, {quad(50)}), Material{DielectricMaterial{}},
                static_cast<float>(opacity));
  }
  const double there = opacity * face + 1 - opacity;
  EXPECT_NEAR(setting.passed(1, 4096) / (there * there), 1, 0.02);
}

// What is not there bounds no medium.
TEST(Coverage, OfWhatBoundsAMedium) {
  for (const float opacity : {0.0f, 1.0f}) {
    Setting setting(Lamp::point);
    Medium medium;
    medium.coefficients = AbsorptionScattering{ConstantSpectrum{2}, ConstantSpectrum{0}};
    setting.scene.media.push_back(medium);
    add_covered(setting.scene, add_quads(setting.scene, box_faces({-50, -50, 0.5f}, {50, 50, 1})),
                Material{InterfaceMaterial{}}, opacity);
    setting.scene.shapes.back().interior = Id<Medium>{0};
    EXPECT_NEAR(setting.passed(1) / (opacity == 0 ? 1 : std::exp(-1)), 1, 5e-3) << "opacity " << opacity;
  }
}

// Chance that decides for one surface must not decide for the next.
TEST(Coverage, OfStacks) {
  Scene scene;
  add_shape(scene, square(scene, -1), black, one);
  for (int i = 0; i < 12; ++i) add_covered(scene, square(scene, 0.01f * static_cast<float>(i)), black, 0.25f);
  expect_luminance(seen_from(scene, 60, 3, 2048), std::pow(0.75, 12), 0.05, "twelve cards");
}

}  // namespace
}  // namespace vitrail::test::means_of_coverage_test
