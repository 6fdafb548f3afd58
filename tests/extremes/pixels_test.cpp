// SPDX-License-Identifier: Apache-2.0
// One pixel, and 32768² of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "farm/render.h"
#include "film/film_progress.h"
#include "partitioner/partition.h"
#include "scene/geometry/portable_math.h"
#include "tests/extremes/measure.h"
#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::pixels_test {
namespace {

constexpr int large = 32768;

// A floor under a point light 2 above its middle, from straight above; the picture is 2 across.
Scene lit_floor(int pixels) {
  Scene scene;
  add_shape(scene, add_quads(scene, {square_at(0, 10)}), matte(0.6f));
  add_point(scene, {0, 0, 2}, 7);
  set_orthographic(scene, {0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 1, pixels);
  scene.settings.max_depth = 1;
  return scene;
}

double radiance_at(double x, double y) {
  const double d2 = x * x + y * y + 4;
  return 0.6 / pi * 7 * (2 / std::sqrt(d2)) / d2;
}

// ∫ over the square |x|, |y| ≤ 1, by the solid angle of a square: I·ω of what it sees.
double mean_over_picture() {
  const double solid_angle = 4 * std::asin(1 / 5.0);  // of a square of half width 1 at distance 2
  return 0.6 / pi * 7 * solid_angle / 4;
}

TEST(Pixels, One) {
  const Film film = render_finite(lit_floor(1), 65536).film;
  expect_relative("one pixel of the whole picture", mean_over_picture(), film.mean(0).y, 2e-5,
                  std::sqrt(film.variance_of_mean(0)));
}

class Cropped {
 public:
  explicit Cropped(const Scene& scene) { partition(scene, directory_ / "scene.vit", {.domains = 1}); }

  Film render(const PixelRect& crop, int samples) const {
    RenderOptions options;
    options.bundle = directory_ / "scene.vit";
    options.outputs.film = directory_ / "scene.film";
    options.picture.samples_per_pixel = samples;
    options.picture.crop = crop;
    options.outputs.force = true;
    int argc = 0;
    char** argv = nullptr;
    const auto transport = make_transport(&argc, &argv);
    vitrail::render(*transport, options);
    return read_film(options.outputs.film, nullptr);
  }

 private:
  TemporaryDirectory directory_;
};

// At the middle of a pixel.
double radiance_of(int column, int row) {
  return radiance_at((column + 0.5) / large * 2 - 1, 1 - (row + 0.5) / large * 2);
}

TEST(Pixels, CropsOfAPictureOfAThousandMillion) {
  const Scene scene = lit_floor(large);
  Scene white = scene;  // with the same wavelengths
  white.lights = {};
  white.area_lights = {lamp(1)};
  white.shapes[0].area_light = Id<AreaLight>{0};
  const Cropped picture(scene), references(white);
  double worst = 0;
  for (const int x0 : {0, large / 2, large - 64}) {
    const PixelRect crop{x0, x0 + 64, large - 64 - x0, large - x0};
    const Film film = picture.render(crop, 4), reference = references.render(crop, 4);
    for (std::uint32_t i = 0; i < pixels_of(film); ++i) {
      const double expected =
          radiance_of(crop.x0 + static_cast<int>(i % 64), crop.y0 + static_cast<int>(i / 64));
      worst = std::max(worst, std::abs(film.mean(i).y / reference.mean(i).y / expected - 1));
    }
  }
  expect_absolute("crops of 32768² pixels: worst pixel, relative", 0, worst, 2e-5);
}

// Pixels of a crop are those of the picture: sums of four quarters, to the bit.
TEST(Pixels, QuartersAreTheWhole) {
  const Cropped picture(lit_floor(large));
  constexpr int x0 = large - 96, y0 = large - 64;
  const Film whole = picture.render({x0, x0 + 32, y0, y0 + 32}, 4);
  std::size_t differ = 0;
  for (const int dx : {0, 16})
    for (const int dy : {0, 16}) {
      const Film part = picture.render({x0 + dx, x0 + dx + 16, y0 + dy, y0 + dy + 16}, 4);
      for (std::uint32_t i = 0; i < 256; ++i) {
        const auto at =
            (static_cast<std::uint32_t>(dy) + i / 16) * 32 + static_cast<std::uint32_t>(dx) + i % 16;
        differ += part.mean(i) != whole.mean(at);
      }
    }
  expect_exactly("quarters of a crop of 32768²: pixels that differ", 0, static_cast<double>(differ));
}

// Of each of 8 × 8 parts a corner of 32², or the whole of 4096²: 1.4 GB and a thousand million samples.
TEST(Pixels, AllPartsOfAPictureOfAThousandMillion) {
  const Cropped picture(lit_floor(large));
  constexpr int part = large / 8;
  const int side = run_whole() ? part : 32;
  double sum = 0, expected = 0, variance = 0;
  for (int x0 = 0; x0 < large; x0 += part)
    for (int y0 = 0; y0 < large; y0 += part) {
      const Film film = picture.render({x0, x0 + side, y0, y0 + side}, 1);
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          const double here = radiance_of(x0 + x, y0 + y);
          const double there = film.mean(static_cast<std::uint32_t>(y * side + x)).y;
          sum += there;
          expected += here;
          variance += (there - here) * (there - here);
        }
    }
  expect_relative(fmt::format("8 × 8 parts of {}² of a picture of 32768²: their light", side), expected, sum,
                  2e-5, std::sqrt(variance));
}

TEST(Pixels, WhatAFilmTakes) {
  FilmSettings settings;
  settings.width = settings.height = 64;
  settings.crop = {0, 64, 0, 64};
  const double each = static_cast<double>(film_bytes(settings)) / (64 * 64);
  report("a film of colours takes a pixel", each, "bytes");
  report("a film of 32768² pixels", each * large * large / 1e9, "GB");
  settings.spectrum.count = 47;
  report("with 47 bins of 10 nm, a pixel", static_cast<double>(film_bytes(settings)) / (64 * 64), "bytes");
}

// The picture of a machine with 4 GB.
TEST(Pixels, WhatDoesNotFitIsRefused) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "what checks addresses needs more of them than the limit leaves";
#endif
  const TemporaryDirectory directory;
  std::ofstream(directory / "large.pbrt")
      << "LookAt 0 0 3 0 0 0 0 1 0 Camera \"orthographic\"\n"
         "Film \"rgb\" \"integer xresolution\" 32768 \"integer yresolution\" 32768\n"
         "WorldBegin LightSource \"point\" \"point3 from\" [0 0 2]\n"
         "Shape \"trianglemesh\" \"point3 P\" [-9 -9 0 9 -9 0 9 9 0] \"integer indices\" [0 1 2]\n";
  const std::string render = "ulimit -v 4000000; " + vitrail("render") + " '" +
                             (directory / "large.pbrt").string() + "' --spp 1 -o '" +
                             (directory / "large.film").string() + "'";
  const CommandResult budget = run(render + " --memory 100M");
  expect_exactly("32768² pixels in --memory 100M: exit status", 4, budget.status);
  EXPECT_NE(budget.output.find("--memory 100M is too little"), std::string::npos) << budget.output;
  const CommandResult whole = run(render), crop = run(render + " --crop 32704,32768,32704,32768");
  expect_exactly("32768² pixels in 4 GB: exit status", 4, whole.status);
  EXPECT_NE(whole.output.find("a large picture is rendered in parts with --crop"), std::string::npos)
      << whole.output;
  expect_exactly("a crop of them: exit status", 0, crop.status);
}

}  // namespace
}  // namespace vitrail::test::pixels_test
