// SPDX-License-Identifier: Apache-2.0
// Lamps seen through stacks of sheets that light passes straight: each sheet meets the same ray, and passing
// it is no event that counts (volumetric integrators' depth), so nothing but its own random numbers keeps a
// sheet apart from the next.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "scene/geometry/portable_math.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/polarised.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::means_of_sheets_test {
namespace {

// Fractions of light that one sheet reflects and lets through.
struct Sheet {
  double reflected, transmitted;
};

// Of one sheet above another (Stokes 1862).
Sheet above(Sheet a, Sheet b) {
  const double between = 1 / (1 - a.reflected * b.reflected);
  return {a.reflected + a.transmitted * a.transmitted * b.reflected * between,
          a.transmitted * b.transmitted * between};
}
Sheet stack_of(Sheet sheet, int count) {
  Sheet all{0, 1};
  for (int i = 0; i < count; ++i) all = above(sheet, all);
  return all;
}

void add_lamp(Scene& scene, float x = 0, float half_width = 1000) {
  add_shape(scene, square(scene, -1, half_width, x), Material{DiffuseMaterial{ConstantSpectrum{0}}},
            AreaLight{ConstantSpectrum{1}});
}

Mean seen_through(const std::vector<Material>& sheets, double theta_deg, float x = 0) {
  Scene scene;
  const float wide = x == 0 ? 1000 : 8;  // far from the origin: a small one
  add_lamp(scene, x, wide);
  if (x != 0) add_shape(scene, square(scene, -1, wide, -x), Material{DiffuseMaterial{ConstantSpectrum{0}}});
  for (std::size_t i = 0; i < sheets.size(); ++i)
    add_shape(scene, square(scene, static_cast<float>(i) * 0.01f, wide, x), sheets[i]);
  look_along(scene, direction(theta_deg, 20), {static_cast<double>(x), 0, 0}, 0.01);
  scene.settings.max_depth = 1000;
  scene.settings.straight_counts = false;
  return mean_of(render(scene, 256).film);
}

Sheet thin_glass(double theta_deg) {
  const double r = over_polarisations([&](Fresnel f) {
    const double face = f(direction(theta_deg).z, 1.5);
    return 2 * face / (1 + face);
  });
  return {r, 1 - r};
}

// A path meets each sheet as unpolarised light does.
TEST(StackedSheets, OfThinGlass) {
  const Material glass{ThinDielectricMaterial{}};
  for (const double theta : {0.0, 60.0, 85.0})
    for (const int count : {1, 2, 4, 8})
      expect_luminance(seen_through(std::vector<Material>(static_cast<std::size_t>(count), glass), theta),
                       stack_of(thin_glass(theta), count).transmitted, 0.02,
                       std::to_string(count) + " sheets at " + std::to_string(theta));
}

TEST(StackedSheets, FarFromTheOrigin) {
  const Material glass{ThinDielectricMaterial{}};
  expect_luminance(seen_through(std::vector<Material>(4, glass), 40, 1000),
                   stack_of(thin_glass(40), 4).transmitted, 0.01, "four sheets");
}

TEST(StackedSheets, OfMeasuredGlass) {
  const Sheet measured{0.3, 0.5};
  MeasuredSheet table;
  table.wavelengths_nm = {550}, table.cosines = {1}, table.reflectance = {0.3f}, table.transmittance = {0.5f};
  const Material material{MeasuredMaterial{"", table}};
  for (const int count : {1, 2, 5})
    expect_luminance(seen_through(std::vector<Material>(static_cast<std::size_t>(count), material), 30),
                     stack_of(measured, count).transmitted, 0.02, std::to_string(count) + " sheets");
}

// Colours that hardly overlap: red passes one, blue the other.
TEST(StackedSheets, OfColouredGlass) {
  MeasuredSheet red;
  red.wavelengths_nm = {500, 600}, red.cosines = {1};
  red.reflectance = {0.5f, 0.05f}, red.transmittance = {0.02f, 0.9f};
  const Material material{MeasuredMaterial{"", red}};
  std::vector<std::array<double, 2>> values;
  for (double lambda = 360; lambda <= 830; ++lambda) {
    const double part = std::clamp((lambda - 500) / 100, 0.0, 1.0);
    values.push_back({lambda, stack_of({0.5 - 0.45 * part, 0.02 + 0.88 * part}, 6).transmitted});
  }
  const XYZ expected = to_xyz(Spectrum{tabulate(values, true)});
  const Mean seen = seen_through(std::vector<Material>(6, material), 0);
  expect_luminance(seen, expected.y, 0.03, "Y", 1e-3);
  EXPECT_NEAR(seen.value.x, expected.x, 4.5 * seen.error.x + 1e-3 * expected.x);
  EXPECT_NEAR(seen.value.z, expected.z, 4.5 * seen.error.z + 1e-3 * expected.y);
}

// Masks and mixtures choose what is there; between them panes of thin glass.
TEST(StackedSheets, OfMasksAndMixtures) {
  Scene scene;
  add_lamp(scene);
  const auto add = [&](const Material& material) {
    scene.materials.push_back(material);
    return Id<Material>{static_cast<std::uint32_t>(scene.materials.size() - 1)};
  };
  const Id<Material> black = add(Material{DiffuseMaterial{ConstantSpectrum{0}}}),
                     glass = add(Material{ThinDielectricMaterial{}}),
                     nothing = add(Material{InterfaceMaterial{}});
  const auto at_height = [&](float z, const MaterialModel& model) {
    add_shape(scene, square(scene, z), Material{model});
  };
  for (int i = 0; i < 3; ++i) {
    const float z = 0.1f * static_cast<float>(i);
    at_height(z, MaskMaterial{0.3f, black});
    at_height(z + 0.02f, BlendMaterial{nothing, black, 0.2f});
    at_height(z + 0.04f, BlendMaterial{glass, nothing, 0.5f});
    at_height(z + 0.06f, MaskMaterial{0.5f, glass});
  }
  look_along(scene, direction(0));
  scene.settings.max_depth = 100;
  scene.settings.straight_counts = false;
  Sheet all{0, 1};
  const Sheet half{thin_glass(0).reflected / 2, (1 + thin_glass(0).transmitted) / 2};
  for (int i = 0; i < 3; ++i)
    for (const Sheet sheet : {Sheet{0, 0.7}, Sheet{0, 0.8}, half, half}) all = above(sheet, all);
  expect_luminance(mean_of(render(scene, 1024).film), all.transmitted, 0.01, "three times four sheets");
}

// A light and a matt floor with sheets between that are not there: whichever way a sheet is passed, the two
// ways to find the light weigh 1 together.
TEST(StackedSheets, LeaveTheWeightsOfLightAlone) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "white.pgm", std::ios::binary) << "P5 2 2 255\n\xff\xff\xff\xff";
  Mean found[2];
  for (const int sheets : {0, 20}) {
    Scene scene;
    ImageTexture white;
    white.filename = directory / "white.pgm";
    white.encoding = Encoding::linear;
    white.filter = TextureFilter::trilinear;
    scene.textures.push_back({white, false, "", {}});
    DiffuseMaterial matt;
    matt.reflectance = Id<Texture>{0};
    add_shape(scene, square(scene, 0, 8), Material{matt});
    add_shape(scene, add_quads(scene, {{{{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}}}),
              Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{1}});
    for (int i = 0; i < sheets; ++i)
      add_shape(scene, square(scene, 1.95f + 0.002f * static_cast<float>(i), 8),
                Material{InterfaceMaterial{}});
    look_along(scene, direction(75), {0, 0, 0}, 0.001);
    scene.settings.max_depth = 1;
    scene.settings.straight_counts = false;
    found[sheets > 0] = mean_of(render(scene, 512).film);
  }
  const double a = 0.5, r = std::sqrt(1 + a * a), factor = 4 * (a / r * std::atan(a / r) * 2) / (2 * pi);
  expect_luminance(found[0], factor, 5e-4, "without sheets", 0);
  expect_luminance(found[1], factor, 5e-4, "behind sheets", 0);
}

}  // namespace
}  // namespace vitrail::test::means_of_sheets_test
