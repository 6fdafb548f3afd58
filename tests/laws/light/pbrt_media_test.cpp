// SPDX-License-Identifier: Apache-2.0
// What shines in pbrt's media, by the units and the grids of each kind of them, against quadrature.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "importers/pbrt/read/pbrt.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"
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

}  // namespace
}  // namespace vitrail::test::pbrt_media_test
