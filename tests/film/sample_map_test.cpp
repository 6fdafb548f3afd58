// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

#include "film/film_noise.h"
#include "film/sample_map.h"

namespace vitrail::sample_map_test {
namespace {

constexpr int width = 40, height = 30;
constexpr std::uint32_t pixels = width * height;

Film film_of(int w, int h) {
  FilmSettings settings;
  settings.width = w, settings.height = h;
  settings.crop = {0, w, 0, h};
  return Film(settings, {});
}

// Four samples of a pixel, two a group, whose groups have the means `a` and `b`.
void put(Film& film, std::uint32_t pixel, double a, double b) {
  for (std::uint32_t s = 0; s < 4; ++s) {
    const double y = s % 2 == 0 ? a : b;
    film.count_sample(pixel, s);
    film.deposit(pixel, s, {y, y, y});
  }
}

// Noisy on the left, and nearly without noise on the right.
Film halves() {
  Film film = film_of(width, height);
  for (std::uint32_t p = 0; p < pixels; ++p) {
    const double scatter = p % width < width / 2 ? 0.4 : 0.004;
    put(film, p, 0.5 + scatter, 0.5 - scatter);
  }
  return film;
}

std::uint64_t sum(const std::vector<std::uint32_t>& map) {
  return std::accumulate(map.begin(), map.end(), std::uint64_t{0});
}

TEST(SampleMap, SpendsWhatThereIsWhereItIsNoisy) {
  const std::vector<std::uint32_t> map = more_samples(halves(), 32 * pixels);
  EXPECT_LE(sum(map), 32u * pixels);
  EXPECT_GE(sum(map), 32u * pixels * 99 / 100);
  EXPECT_TRUE(std::ranges::all_of(
      map, [](std::uint32_t n) { return std::has_single_bit(n + 4) || (n + 4) % 3 == 0; }));
  const std::uint32_t noisy = map[15 * width + 5], calm = map[15 * width + 35];
  EXPECT_NEAR(noisy, 60, 4);
  EXPECT_NEAR(calm, 4, 2) << "an eighth of the mean";
}

// Whatever is seen in it by then.
TEST(SampleMap, AnUnevenFilmGrowsInProportion) {
  Film film = halves();
  for (std::uint32_t p = 0; p < pixels; ++p)
    for (int i = 0; i < (p % width > width / 2 ? 3 : 0); ++i) put(film, p, 0.5, 0.5);
  const std::vector<std::uint32_t> map = more_samples(film, film.samples());
  for (std::uint32_t p = 0; p < pixels; ++p) EXPECT_EQ(map[p], film.samples(p)) << p;
}

// What a pixel has seen moves its neighbours' numbers and the scale of all, but not its own share.
TEST(SampleMap, APixelsOwnSamplesDoNotCount) {
  Film film = film_of(width, height);
  for (std::uint32_t p = 0; p < pixels; ++p) put(film, p, 0.6, 0.4);
  // Two pixels with the same neighbours as far as they go, one of them noisy and one without noise.
  Film other = film_of(width, height);
  const std::uint32_t one = 8 * width + 8, two = 20 * width + 30;
  for (std::uint32_t p = 0; p < pixels; ++p)
    p == one ? put(other, p, 1, 0) : p == two ? put(other, p, 0.5, 0.5) : put(other, p, 0.6, 0.4);
  const auto map = more_samples(other, 64 * pixels), alike = more_samples(film, 64 * pixels);
  EXPECT_NEAR(map[one], map[two], 2);
  EXPECT_NEAR(alike[one], map[one], 2);
}

// A bright speck draws few samples about itself, and none to where it is.
TEST(SampleMap, SpecksAreLeftOut) {
  Film film = film_of(width, height);
  for (std::uint32_t p = 0; p < pixels; ++p) put(film, p, 0.51, 0.49);
  const auto before = more_samples(film, 16 * pixels);
  Film specks = film_of(width, height);
  for (std::uint32_t p = 0; p < pixels; ++p)
    p % width % 10 == 5 && p / width % 10 == 5 ? put(specks, p, 1000, 0) : put(specks, p, 0.51, 0.49);
  const auto after = more_samples(specks, 16 * pixels);
  for (std::uint32_t p = 0; p < pixels; ++p) EXPECT_NEAR(after[p], before[p], 2) << p;
}

TEST(SampleMap, OfAFilmWithoutNoiseOrNeighboursIsEven) {
  Film film = film_of(width, height);
  for (std::uint32_t p = 0; p < pixels; ++p) put(film, p, 0.5, 0.5);
  EXPECT_EQ(more_samples(film, 12 * pixels), std::vector<std::uint32_t>(pixels, 12));
  Film one = film_of(1, 1);
  put(one, 0, 1, 0);
  EXPECT_EQ(more_samples(one, 12), std::vector<std::uint32_t>{12});
}

TEST(Noise, IsTheMeanOfRelativeVariances) {
  Film film = film_of(width, height);
  for (std::uint32_t p = 0; p < pixels; ++p) put(film, p, 0.52, 0.48);
  // d = 0.04, of n₀ = n₁ the variance is d²/4.
  const NoiseEstimate relative = relative_squared_error(film);
  EXPECT_NEAR(relative.mean, 0.0004 / (0.52 * 0.48 + 0.01), 1e-9);
  EXPECT_NEAR(relative.standard_error, 0, 1e-9);
  const double slope = 116.0 / 3 * std::pow(0.52 * 0.48, -1.0 / 3);
  EXPECT_NEAR(displayed_squared_error(film).mean, 0.0004 * slope * slope / (2.3 * 2.3), 1e-7);
}

// Where the film is dark L* is linear, and where it is white nothing is seen.
TEST(Noise, IsAsItIsShown) {
  Film film = film_of(6, 1);
  for (const std::uint32_t p : {0, 1, 2}) put(film, p, 0.0011, 0.0009);
  for (const std::uint32_t p : {3, 4, 5}) put(film, p, 3, 2);
  EXPECT_NEAR(displayed_squared_error(film).mean, 0.0001 * 0.0001 * std::pow(24389.0 / 27 / 2.3, 2) / 2,
              1e-6);
}

TEST(Noise, ASpeckDoesNotDivideByItself) {
  Film film = film_of(width, height);
  for (std::uint32_t p = 0; p < pixels; ++p) put(film, p, 0.5, 0.5);
  Film speck = film_of(width, height);
  for (std::uint32_t p = 0; p < pixels; ++p) p == 500 ? put(speck, p, 100, 0.5) : put(speck, p, 0.5, 0.5);
  const NoiseEstimate noise = relative_squared_error(speck);
  EXPECT_NEAR(noise.mean, 99.5 * 99.5 / 4 / 0.26 / pixels, 0.01);
  EXPECT_GT(noise.standard_error, noise.mean) << "one pixel says it all";
}

// A lamp before the dark, of which the pixels at its edge have no sample yet: no group differs.
TEST(Noise, WhatAnEdgeHidesIsUncertain) {
  Film film = film_of(width, height), flat = film_of(width, height);
  for (std::uint32_t p = 0; p < pixels; ++p)
    put(film, p, p == 500 ? 10 : 0.01, p == 500 ? 10 : 0.01), put(flat, p, 1, 1);
  const NoiseEstimate noise = relative_squared_error(film);
  EXPECT_NEAR(noise.mean, 0, 1e-9);
  // Half a sample of four, of one in two of eight pixels.
  const double each = 0.5 * std::pow((10 - 0.01) / 8, 2) / (0.01 * 0.01 + 0.01);
  EXPECT_NEAR(noise.standard_error, each * std::sqrt(8.0) / pixels, 1e-4);
  EXPECT_EQ(relative_squared_error(flat).upper(), 0);
}

// The ratio of two χ² of n degrees that is exceeded in 3 % of cases: for n = 2 it is (1 − q)/q itself, for
// n = 1 tan²(π(½ − q/2)). Of many pixels it is less than 2.33 standard errors.
TEST(Noise, OfFewPixelsIsHardlyKnown) {
  const auto bound = [](int count) {
    Film film = film_of(count, 1);
    for (std::uint32_t p = 0; p < film.pixels(); ++p) put(film, p, 0.52, 0.48);
    const NoiseEstimate noise = relative_squared_error(film);
    return noise.upper() / noise.mean;
  };
  EXPECT_NEAR(bound(1), std::pow(std::tan(std::numbers::pi * (0.5 - 0.03 / 2)), 2), 1);
  EXPECT_NEAR(bound(2), 0.97 / 0.03, 0.02);
  EXPECT_GT(bound(3), 13);
  EXPECT_LT(bound(1000), 1.13);
}

}  // namespace
}  // namespace vitrail::sample_map_test
