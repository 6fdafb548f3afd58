// SPDX-License-Identifier: Apache-2.0
// Adaptive samples are unbiased, and a picture that was to have an error has it. tests/bench/adaptive.py
// measures the same on more scenes and seeds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "film/film_progress.h"
#include "partitioner/partition.h"
#include "tests/support/long_tests.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::adaptive_test {
namespace {

class Films {
 public:
  explicit Films(const Scene& scene) : transport_(make_transport(&argc_, nullptr)) {
    partition(scene, directory_ / "scene.vit", {});
  }
  Film render(RenderOptions options, std::uint64_t seed) const {
    options.bundle = directory_ / "scene.vit";
    options.outputs.film = directory_ / "scene.film";
    options.picture.seed = seed;
    options.outputs.force = options.outputs.quiet = true;
    vitrail::render(*transport_, options);
    return read_film(options.outputs.film, nullptr);
  }

 private:
  TemporaryDirectory directory_;
  int argc_ = 0;
  std::unique_ptr<Transport> transport_;
};

constexpr int side = 48;

// Squares that shine, each of 0.09 of a pixel, in the dark. A pixel that went by its own samples would take
// more where it has hit one, and be too dark on the average.
Scene stars() {
  Scene scene;
  std::vector<std::array<Point3f, 4>> quads;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> at(2, side - 2);
  for (int i = 0; i < 220; ++i) {
    // The picture is ±1 at the distance 1.
    const float size = 0.3f * 2 / side, x = at(random) * 2 / side - 1, y = at(random) * 2 / side - 1;
    const float z = 1 + 1e-4f * static_cast<float>(i);
    quads.push_back({{{x, y, z}, {x, y + size, z}, {x + size, y + size, z}, {x + size, y, z}}});
  }
  add_shape(scene, add_quads(scene, quads), Material{DiffuseMaterial{ConstantSpectrum{0}}},
            AreaLight{ConstantSpectrum{1}, true});
  set_camera(scene, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 2 * std::atan(1.0), side, side);
  scene.settings.max_depth = 1;
  return scene;
}

struct Mean {
  double value = 0, standard_error = 0, most_of_a_pixel = 0;
};

Mean mean_of(const Films& films, const RenderOptions& options, int seeds) {
  double sum = 0, squares = 0, most = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const Film film = films.render(options, static_cast<std::uint64_t>(seed));
    const double y = brightness(film).mean;
    sum += y, squares += y * y;
    for (std::uint32_t p = 0; p < film.pixels(); ++p)
      most = std::max(most, static_cast<double>(film.samples(p)));
  }
  const double mean = sum / seeds;
  return {mean, std::sqrt((squares / seeds - mean * mean) / (seeds - 1)), most};
}

TEST(Adaptive, MeansAreThoseOfUniformSamples) {
  const Films films(stars());
  RenderOptions uniform;
  uniform.picture.samples_per_pixel = 512;
  const Mean truth = mean_of(films, uniform, of_all(8, 4));
  RenderOptions adaptive;
  adaptive.picture.samples_per_pixel = 32;
  adaptive.picture.adaptive = true;
  const Mean found = mean_of(films, adaptive, 80);
  const double error = std::hypot(truth.standard_error, found.standard_error);
  fmt::print("adaptive over truth: {:.4f} ± {:.4f}\n", found.value / truth.value, error / truth.value);
  EXPECT_GT(found.most_of_a_pixel, 64) << "the samples are uniform";
  EXPECT_LT(error, 0.01 * truth.value);
  EXPECT_NEAR(found.value, truth.value, 3.5 * error);
}

// A square that shines and covers a known part of the picture: its edges alone are noisy.
TEST(Adaptive, CoverageIsExact) {
  Scene scene;
  const float a = 0.62f;
  add_shape(scene, add_quads(scene, {{{{-a, 0.1f, 1}, {0.05f, a, 1}, {a, -0.1f, 1}, {-0.05f, -a, 1}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{1}, true});
  set_camera(scene, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 2 * std::atan(1.0), side, side);
  scene.settings.max_depth = 1;
  // Half the cross product of the diagonals, of the picture's 4.
  const double covered = std::abs(2 * a * (-2 * a) - (-0.2) * (-0.1)) / 2 / 4;
  RenderOptions options;
  options.picture.samples_per_pixel = 32;
  options.picture.adaptive = true;
  const Mean found = mean_of(Films(scene), options, 32);
  EXPECT_NEAR(found.value, covered, 4 * found.standard_error);
  EXPECT_LT(found.standard_error, 1e-4);
}

double relative_error(const Film& film, const std::vector<double>& truth) {
  double sum = 0;
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    const double d = film.mean(p).y - truth[p];
    sum += d * d / (truth[p] * truth[p] + 0.01);
  }
  return sum / film.pixels();
}

// Of 20 seeds 18 at least: it is 19 that the bound lets expect.
void expect_target_kept(const Scene& scene, double target) {
  const Films films(scene);
  constexpr int seeds = 20;
  std::vector<Film> all;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    RenderOptions options;
    options.picture.target_error = TargetError{target};
    all.push_back(films.render(options, seed));
  }
  int below = 0, above = 0;
  std::vector<double> sum(all[0].pixels());
  for (const Film& film : all)
    for (std::uint32_t p = 0; p < film.pixels(); ++p) sum[p] += film.mean(p).y;
  double ratios = 0;
  for (const Film& film : all) {
    std::vector<double> others = sum;
    for (std::uint32_t p = 0; p < film.pixels(); ++p) others[p] = (sum[p] - film.mean(p).y) / (seeds - 1);
    // The others' mean has a variance of its own, of 1/(n − 1) of a film's.
    const double error = relative_error(film, others) * (1 - 1.0 / seeds);
    ratios += error / target / seeds;
    below += error < target;
    above += error > target / 4;
  }
  fmt::print("true error: {:.2f} of the target, {} of {} below it, {} above a quarter\n", ratios, below,
             seeds, above);
  EXPECT_GE(below, 18);
  EXPECT_GE(above, 18);
}

// The error of one pixel is of one degree of freedom, and so is what its two groups say of it. Of 40 seeds
// 36: nine in ten are promised.
void expect_target_kept_in_few_pixels(const Scene& scene, int x, int y, double target) {
  const Films films(scene);
  constexpr int seeds = 40, most_pixels = 3;
  RenderOptions options;
  options.picture.crop = PixelRect{x, x + most_pixels, y, y + 1};
  options.picture.samples_per_pixel = 1 << 17;
  const Film long_film = films.render(options, 1000);
  options.picture.samples_per_pixel.reset();
  options.picture.target_error = TargetError{target};
  for (int pixels = 1; pixels <= most_pixels; ++pixels) {
    options.picture.crop->x1 = x + pixels;
    std::vector<double> truth;
    for (int p = 0; p < pixels; ++p) truth.push_back(long_film.mean(static_cast<std::uint32_t>(p)).y);
    int below = 0;
    double samples = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const Film film = films.render(options, seed);
      below += relative_error(film, truth) < target;
      samples += static_cast<double>(film.samples()) / pixels / seeds;
    }
    fmt::print("{} pixels: {} of {} below the target, with {:.0f} samples a pixel\n", pixels, below, seeds,
               samples);
    EXPECT_GE(below, 36) << pixels << " pixels";
  }
}

TEST(TargetError, IsKeptInFewPixelsOfABox) { expect_target_kept_in_few_pixels(lit_box(32), 14, 20, 1e-3); }
TEST(TargetError, IsKeptInFewPixelsOfStars) { expect_target_kept_in_few_pixels(stars(), 20, 22, 0.004); }

TEST(TargetError, IsKeptInABox) { expect_target_kept(lit_box(32), 1e-3); }
TEST(TargetError, IsKeptAmongStars) { expect_target_kept(stars(), 0.002); }

}  // namespace
}  // namespace vitrail::test::adaptive_test
