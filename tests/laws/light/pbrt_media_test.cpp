// SPDX-License-Identifier: Apache-2.0
// What shines in pbrt's media, by the units and the grids of each kind of them, against quadrature.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "importers/pbrt/read/pbrt.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "scene/spectra/spectrum.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::pbrt_media_test {
namespace {

// Through the middle of the medium's unit cube, along z.
Mean through_the_middle(const std::string& medium, const std::string& before = "") {
  const TemporaryDirectory folder;
  const auto file = folder / "scene.pbrt";
  std::ofstream(file) << "Film \"rgb\"\nWorldBegin\n"
                      << before << "MakeNamedMedium \"m\" \"string type\" " << medium
                      << "\nMediumInterface \"m\" \"\" Material \"interface\"\n"
                         "Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 3 2] "
                         "\"point3 P\" [-5 -5 0 5 -5 0 5 5 0 -5 5 0]\n"
                         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
                         "\"point3 P\" [-5 -5 1 5 -5 1 5 5 1 -5 5 1]\n";
  Scene scene = read_pbrt(file).scene;
  look_along(scene, {0, 0, 1}, {0.5, 0.5, 0.5}, 1e-4);
  scene.settings.max_depth = 1;
  return mean_of(render(scene, 1024).film);
}

// ∫ σ(z)·L(z)·e^{−∫σ} dz from z = 1 down.
template <class Sigma, class Glow>
double glow_of(const Sigma& sigma, const Glow& glow) {
  constexpr int steps = 2000;
  double depth = 0, sum = 0;
  for (int i = steps - 1; i >= 0; --i) {
    const double z = (i + 0.5) / steps, here = sigma(z) / steps;
    sum += std::exp(-depth - here / 2) * here * glow(z);
    depth += here;
  }
  return sum;
}

double even(double) { return 1; }
// A cell of 1 between zeros.
double tent(double z) { return 1 - std::abs(z - 0.5); }
// Two cells of 1.
double plateau(double z) { return std::min(1.0, 0.5 + 2 * std::min(z, 1 - z)); }

constexpr const char* absorbs = " \"rgb sigma_a\" [1 1 1] \"rgb sigma_s\" [0 0 0] \"rgb Le\" [1 1 1]";

TEST(PbrtMedia, Homogeneous) {
  expect_luminance(through_the_middle(std::string("\"homogeneous\"") + absorbs), glow_of(even, even), 0.01,
                   "", 2e-3);
  expect_luminance(through_the_middle(std::string("\"homogeneous\" \"float Lescale\" 3") + absorbs),
                   3 * glow_of(even, even), 0.01, "", 2e-3);
}

// All grids fall to half at the edge of their bounds; that of what shines is one cell where none is given.
TEST(PbrtMedia, UniformGrid) {
  expect_luminance(through_the_middle(std::string("\"uniformgrid\" \"float density\" [1]") + absorbs),
                   glow_of(tent, tent), 0.01, "one cell", 2e-3);
  const std::string two = std::string("\"uniformgrid\" \"integer nz\" 2 \"float density\" [1 1]") + absorbs;
  expect_luminance(through_the_middle(two), glow_of(plateau, tent), 0.01, "two cells, no Lescale", 2e-3);
  expect_luminance(through_the_middle(two + " \"float Lescale\" [1 1]"), glow_of(plateau, plateau), 0.01,
                   "two cells", 2e-3);
  expect_luminance(
      through_the_middle(two + " \"float Lescale\" [2 0]"),
      glow_of(plateau, [](double z) { return z < 0.25 ? 1 + 4 * z : std::max(0.0, 2 - 4 * (z - 0.25)); }),
      0.01, "the lower of two cells", 2e-3);
}

// Its colours are of an illuminant that nothing normalises.
TEST(PbrtMedia, RgbGrid) {
  const auto grid = [](const std::string& le) {
    return through_the_middle("\"rgbgrid\" \"rgb sigma_a\" [1 1 1] \"rgb sigma_s\" [0 0 0] \"rgb Le\" " + le);
  };
  const double white = cie_y_integral_nm * glow_of(tent, tent);
  expect_luminance(grid("[1 1 1]"), white, 0.01, "white", 2e-3);
  const Mean red = grid("[1 .1 .1]");
  const XYZ color = to_xyz(Spectrum{emission_from_rgb({1, 0.1, 0.1})});
  expect_luminance(red, white * color.y, 0.01, "red", 5e-3);
  EXPECT_NEAR(red.value.x / red.value.y, color.x / color.y, 0.02 * color.x / color.y);
  EXPECT_NEAR(red.value.z / red.value.y, color.z / color.y, 0.05 * color.z / color.y);
}

// Beyond its bounds there is nothing.
TEST(PbrtMedia, RgbGridEndsWithItsBounds) {
  expect_luminance(
      through_the_middle("\"rgbgrid\" \"point3 p0\" [0 0 0] \"point3 p1\" [1 1 .5] \"rgb sigma_a\" [1 1 1] "
                         "\"rgb sigma_s\" [0 0 0] \"rgb Le\" [1 1 1]"),
      cie_y_integral_nm * glow_of([](double z) { return z < 0.5 ? 1 - std::abs(2 * z - 0.5) : 0; },
                                  [](double z) { return z < 0.5 ? 1 - std::abs(2 * z - 0.5) : 0; }),
      0.01, "", 2e-3);
}

// The luminance of a blackbody whose greatest radiance is 1, by a film that nothing normalises.
double luminance_at(double kelvin) {
  return kelvin > 100 ? cie_y_integral_nm * luminance(Spectrum{blackbody(kelvin)}) : 0;
}

// Its radiance is that of a blackbody over its greatest, times Lescale, whose grid is one cell where none is
// given. Temperatures are linear between cells.
TEST(PbrtMedia, Temperature) {
  const std::string two =
      "\"uniformgrid\" \"integer nz\" 2 \"float density\" [1 1] \"rgb sigma_a\" [1 1 1] \"rgb sigma_s\" [0 0 "
      "0] ";
  expect_luminance(through_the_middle(two + "\"float temperature\" [6000 6000] \"float Lescale\" [1 1]"),
                   glow_of(plateau, [](double z) { return plateau(z) * luminance_at(6000 * plateau(z)); }),
                   0.02, "6000 K", 3e-3);
  expect_luminance(through_the_middle(two + "\"float temperature\" [6000 6000]"),
                   glow_of(plateau, [](double z) { return tent(z) * luminance_at(6000 * plateau(z)); }), 0.02,
                   "no Lescale", 3e-3);
  const auto moved = [](double z) { return tent(z) * luminance_at(2 * (2500 * plateau(z) - 300)); };
  const Mean warm = through_the_middle(two +
                                       "\"float temperature\" [2500 2500] \"float temperatureoffset\" 300 "
                                       "\"float temperaturescale\" 2");
  expect_luminance(warm, glow_of(plateau, moved), 0.02, "moved and stretched", 3e-3);
  EXPECT_GT(warm.value.x, 1.1 * warm.value.z);
  EXPECT_EQ(through_the_middle(two + "\"float temperature\" [100 100]").value.y, 0);
}

// A slab of one temperature, in the middle of cells that are alike: (1 − e^{−σ})·B(T). That is B(T) where it
// is thick, and σ·B(T) where it is thin.
TEST(PbrtMedia, ASlabOfOneTemperature) {
  const auto slab = [](double sigma, double kelvin) {
    return through_the_middle(fmt::format(
        "\"uniformgrid\" \"integer nz\" 2 \"point3 p0\" [-9 -9 -9] \"point3 p1\" [10 10 10] \"rgb sigma_a\" "
        "[{0} {0} {0}] \"rgb sigma_s\" [0 0 0] \"float density\" [1 1] \"float temperature\" [{1} {1}] "
        "\"float "
        "Lescale\" [1 1]",
        sigma, kelvin));
  };
  for (const double kelvin : {1500.0, 6504.0})
    for (const double sigma : {0.01, 1.0, 30.0}) {
      const XYZ of_one = to_xyz(Spectrum{blackbody(kelvin)});
      const double expected = -std::expm1(-sigma) * luminance_at(kelvin);
      const std::string what = fmt::format("{} K, {}", kelvin, sigma);
      const Mean mean = slab(sigma, kelvin);
      expect_luminance(mean, expected, 0.02, what.c_str(), 3e-3);
      EXPECT_NEAR(mean.value.x / mean.value.y, of_one.x / of_one.y, 0.02 * of_one.x / of_one.y) << what;
      EXPECT_NEAR(mean.value.z / mean.value.y, of_one.z / of_one.y, 0.03 * of_one.z / of_one.y) << what;
    }
}

}  // namespace
}  // namespace vitrail::test::pbrt_media_test
