// SPDX-License-Identifier: Apache-2.0
// Bases below coats, of the same albedo in another model.
#include "importers/writing/coat_albedo.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/pbrt/read/pbrt.h"
#include "importers/pbrt/write/write_pbrt.h"
#include "importers/writing/export_colors.h"
#include "scene/geometry/pi.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::coat_albedo_test {
namespace {

// What comes out of a base ρ below a coat that light goes back and forth under: a geometric series.
double albedo_below(double base, double eta) {
  const double in = 1 - diffuse_fresnel_outside(eta), inside = diffuse_fresnel_inside(eta);
  double sum = 0, going_up = in * base;
  for (int i = 0; i < 2000; ++i) sum += going_up * (1 - inside), going_up *= inside * base;
  return sum;
}

TEST(CoatAlbedo, TheSeriesHasTheAlbedo) {
  for (const double eta : {1.3, 1.49, 1.9})
    for (const double albedo : {0.0, 0.1, 0.5, 0.9}) {
      const double in = 1 - diffuse_fresnel_outside(eta);
      EXPECT_NEAR(albedo_below(base_below_coat(albedo, eta, DiffuseAlbedo::of_what_gets_in), eta),
                  in * albedo, 1e-6);
      const double all = std::min(albedo, in);  // more does not get in
      EXPECT_NEAR(albedo_below(base_below_coat(albedo, eta, DiffuseAlbedo::of_all), eta), all, 1e-6);
    }
  EXPECT_EQ(base_below_coat(1, 1.5, DiffuseAlbedo::of_all), 1);
  EXPECT_EQ(base_below_coat(0.3, 1, DiffuseAlbedo::of_all), 0.3);
}

TEST(CoatAlbedo, ColoursAndTables) {
  const auto of = DiffuseAlbedo::of_what_gets_in;
  const RGB color = factor_rgb(base_below_coat(Spectrum{reflectance_from_rgb({0.2, 0.4, 0.6})}, 1.5, of));
  EXPECT_NEAR(color.r, base_below_coat(0.2, 1.5, of), 1e-6);
  EXPECT_NEAR(color.b, base_below_coat(0.6, 1.5, of), 1e-6);
  TabulatedSpectrum table;
  table.values.assign(table_size, 0.4f);
  EXPECT_NEAR(evaluate(base_below_coat(Spectrum{table}, 1.5, of), 550), base_below_coat(0.4, 1.5, of), 1e-6);
}

TEST(CoatAlbedo, WhatPbrtGets) {
  const TemporaryFolder folder;
  const auto reflectance = [&](MaterialModel model) {
    write_pbrt(square_scene(Material{std::move(model)}), folder / "out.pbrt");
    const Scene again = read_pbrt(folder / "out.pbrt").scene;
    const auto& coat = std::get<CoatedDiffuseMaterial>(again.materials.at(0).model);
    EXPECT_EQ(coat.volume.max_depth, 100) << "pbrt's 10 end a light base's walk too soon";
    return evaluate(std::get<Spectrum>(coat.reflectance), 550);
  };
  PlasticMaterial plastic{.diffuse_reflectance = ConstantSpectrum{0.4f}, .eta = 1.5f, .exterior_eta = 1};
  EXPECT_NEAR(reflectance(plastic), base_below_coat(0.4, 1.5, DiffuseAlbedo::of_what_gets_in), 1e-5);
  plastic.nonlinear = true;
  EXPECT_NEAR(reflectance(plastic), 0.4, 1e-6) << "it goes back and forth already";
  PrincipledMaterial principled{.base_color = ConstantSpectrum{0.4f}, .roughness = 0.1f};
  EXPECT_NEAR(reflectance(principled), base_below_coat(0.4, 1.5, DiffuseAlbedo::of_all), 1e-5);
  principled.below = true;
  EXPECT_NEAR(reflectance(principled), base_below_coat(0.4, 1.5, DiffuseAlbedo::of_what_gets_in), 1e-5);
}

// pbrt's marble: a curve of nine points, six segments of it, along which a sine goes; its colours are 1.5
// times these.
TEST(ExportColors, MarblesMeanIsThatOfItsCurve) {
  constexpr std::array<std::array<double, 3>, 4> colors{
      {{.58, .58, .6}, {.5, .5, .5}, {.6, .59, .58}, {.2, .2, .33}}};
  constexpr std::array<std::size_t, 9> curve{0, 0, 0, 1, 2, 0, 0, 3, 0};
  constexpr int steps = 20000;
  std::array<double, 3> mean{};
  for (int i = 0; i < steps; ++i) {
    const double along = 3 + 3 * std::sin(2 * pi * (i + 0.5) / steps), t = along - std::floor(along),
                 s = 1 - t;
    const std::array<double, 4> weights{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        mean[c] += 1.5 * weights[k] * colors[curve[static_cast<std::size_t>(along) + k]][c] / steps;
  }
  NoiseTexture marble;
  marble.kind = NoiseTexture::Kind::marble;
  const RGB found = mean_of_noise(marble);
  EXPECT_NEAR(found.r, mean[0], 1e-3);
  EXPECT_NEAR(found.g, mean[1], 1e-3);
  EXPECT_NEAR(found.b, mean[2], 1e-3);
}

}  // namespace
}  // namespace vitrail::coat_albedo_test
