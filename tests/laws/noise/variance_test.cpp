// SPDX-License-Identifier: Apache-2.0
// The variance that a film estimates is that of its means: against their scatter over many seeds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "film/film_progress.h"
#include "partitioner/partition.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::variance_test {
namespace {

constexpr int side = 24, seeds = 24, block = 6;

// A lit box and a block: what stratified samples are good at.
Scene box() {
  Scene scene = lit_box(side);
  add_shape(scene, add_quads(scene, box_faces({-.5f, -1, 0}, {.1f, .1f, .6f})),
            Material{DiffuseMaterial{ConstantSpectrum{0.6f}}});
  return scene;
}

// Of the mean Y over some pixels: the scatter over the films beside what they estimate of it, by the mean of
// their estimates. (n − 1)·truth/estimate is χ² of n − 1 degrees of freedom if the two are the same.
double chi_squared(const std::vector<Film>& films, const std::vector<std::uint32_t>& pixels) {
  const double n = static_cast<double>(films.size());
  double sum = 0, squares = 0, estimate = 0;
  for (const Film& film : films) {
    double y = 0;
    for (const std::uint32_t p : pixels) y += film.mean(p).y, estimate += film.variance_of_mean(p) / n;
    sum += y, squares += y * y;
  }
  return (squares - sum * sum / n) / estimate;
}

std::vector<Film> films_of(std::uint32_t samples, std::uint64_t first_seed) {
  const TemporaryDirectory directory;
  partition(box(), directory / "box.vit", {});
  int argc = 0;
  const auto transport = make_transport(&argc, nullptr);
  std::vector<Film> films;
  for (std::uint64_t seed = first_seed; seed < first_seed + seeds; ++seed) {
    RenderOptions options;
    options.bundle = directory / "box.vit";
    options.outputs.film = directory / "box.film";
    options.picture.samples_per_pixel = static_cast<int>(samples);
    options.picture.seed = seed;
    options.outputs.force = true;
    vitrail::render(*transport, options);
    films.push_back(read_film(options.outputs.film, nullptr));
  }
  return films;
}

// Blocks of 6 × 6 pixels together are χ² of f = 16 · 23 degrees of freedom, of standard deviation √(2f). That
// of a single pixel, whose estimate has 24, is as F: of 576 the median is that of F(23, 24) within 1.25 ·
// 0.42/24.
void expect_honest(const std::vector<Film>& films, const std::string& what) {
  constexpr double freedom_of_one = seeds - 1;
  std::vector<double> ratios;
  for (std::uint32_t p = 0; p < side * side; ++p) ratios.push_back(chi_squared(films, {p}) / freedom_of_one);
  std::ranges::nth_element(ratios, ratios.begin() + side * side / 2);
  const double median = ratios[side * side / 2];
  double sum = 0, freedom = 0;
  for (std::uint32_t y = 0; y < side; y += block)
    for (std::uint32_t x = 0; x < side; x += block) {
      std::vector<std::uint32_t> pixels;
      for (std::uint32_t i = 0; i < block * block; ++i)
        pixels.push_back((y + i / block) * side + x + i % block);
      sum += chi_squared(films, pixels);
      freedom += freedom_of_one;
    }
  fmt::print("{}: estimate over truth: median pixel {:.3f}, blocks {:.3f} ± {:.3f}\n", what, 1 / median,
             freedom / sum, std::sqrt(2 / freedom));
  EXPECT_NEAR(median, 1, 0.11) << what;  // of three samples, over six sets of seeds, .90 to .96
  EXPECT_NEAR(sum, freedom, 4 * std::sqrt(2 * freedom)) << what;
}

TEST(Variance, IsThatOfTheMeans) {
  for (const std::uint32_t samples : {4u, 16u, 64u})
    expect_honest(films_of(samples, 100), fmt::format("{} samples", samples));
}

// A last round in which some groups have a sample more: stratified, it is worth far less or more than the
// others.
TEST(Variance, OfAnyNumberOfSamples) {
  for (const std::uint32_t samples : {3u, 17u, 34u, 67u})
    expect_honest(films_of(samples, 200), fmt::format("{} samples", samples));
}

TEST(Variance, OfMergedFilms) {
  std::vector<Film> films = films_of(9, 300);
  std::vector<Film> others = films_of(6, 400);
  for (std::size_t i = 0; i < films.size(); ++i) films[i].merge(others[i]);
  expect_honest(films, "9 and 6 samples");
}

}  // namespace
}  // namespace vitrail::test::variance_test
