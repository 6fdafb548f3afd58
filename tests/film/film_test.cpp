// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <gtest/gtest.h>

#include <barrier>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "film/develop.h"
#include "scene/diagnostics.h"

namespace vitrail {
namespace {

FilmSettings settings(int width, int height) {
  FilmSettings s;
  s.width = width, s.height = height;
  s.crop = {0, width, 0, height};
  return s;
}

Film film_of(std::uint64_t seed, int width = 4, int height = 3) {
  return Film(settings(width, height), {1, 2, seed});
}

// n samples a pixel, of luminance μ + σ·(normal).
void fill(Film& film, std::uint32_t n, unsigned random_seed, double mu = 5, double sigma = 1) {
  std::mt19937 random(random_seed);
  std::normal_distribution<double> normal(mu, sigma);
  for (std::uint32_t p = 0; p < film.counts().size(); ++p)
    for (std::uint32_t s = 0; s < n; ++s) {
      const double y = normal(random);
      film.count_sample(p);
      ASSERT_TRUE(film.deposit(p, s, {0.5 * y, y, 2 * y}));
    }
}

Film sum(Film a, const Film& b) {
  a.merge(b);
  return a;
}

TEST(Film, MeanIsSumOverCountTimesRatio) {
  FilmSettings s = settings(2, 1);
  s.imaging_ratio = 3;
  Film film(s, {});
  for (std::uint32_t i = 0; i < 4; ++i) film.count_sample(1);
  ASSERT_TRUE(film.deposit(1, 0, {1, 2, 3}));
  ASSERT_TRUE(film.deposit(1, 2, {1, -2, 5}));
  ASSERT_TRUE(film.deposit(1, 3, {0, 4, 0}));
  EXPECT_EQ(film.mean(1), (XYZ{1.5, 3, 6}));
  EXPECT_EQ(film.mean(0), XYZ{});
  EXPECT_EQ(film.samples(1), 4u);
}

TEST(Film, RoundsEachDepositToNearestEven) {
  Film film = film_of(1);
  ASSERT_TRUE(film.deposit(0, 0, {0x1.8p-32, 0x0.8p-32, -0x1.8p-32}));
  EXPECT_EQ(film.sums()[0], 2);
  EXPECT_EQ(film.sums()[2 * film.counts().size()], 0);
  EXPECT_EQ(film.sums()[film.counts().size()], -2);
}

TEST(Film, RefusesWhatDoesNotFitAndAddsNothing) {
  Film film = film_of(1);
  const std::uint64_t before = film.hash();
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 0x1p30, -0x1p30}) {
    EXPECT_FALSE(film.deposit(0, 0, {bad, 1, 1}));
    EXPECT_FALSE(film.deposit(0, 0, {1, bad, 1}));
    EXPECT_FALSE(film.deposit(0, 0, {1, 1, bad}));
  }
  EXPECT_EQ(film.hash(), before);
  EXPECT_TRUE(film.deposit(0, 0, {std::nextafter(0x1p30, 0), 1, 1}));
}

TEST(Film, SaturationIsSeenAndStays) {
  Film film = film_of(1);
  const XYZ huge{0, std::nextafter(0x1p30, 0), 0};
  EXPECT_TRUE(film.deposit(0, 0, huge));
  EXPECT_FALSE(film.saturated());
  for (int i = 0; i < 20; ++i) film.deposit(0, 0, huge);
  EXPECT_TRUE(film.saturated());
  EXPECT_FALSE(film.deposit(0, 0, huge));
  EXPECT_TRUE(sum(film, film).saturated());
  EXPECT_THROW(develop(film), Error);
}

TEST(Film, ThreadsAndOrderDoNotMatter) {
  constexpr std::uint32_t samples = 1000000, thread_count = 4;
  Film forward = film_of(1, 1, 1), together = film_of(1, 1, 1);
  const auto deposit = [](Film& film, std::uint32_t s) {
    film.count_sample(0);
    film.deposit(0, s, {1e-5 * s, 1.0 / (1 + s), -3e-5 * s});
  };
  for (std::uint32_t s = 0; s < samples; ++s) deposit(forward, s);
  std::barrier start(thread_count);
  std::vector<std::thread> threads;
  for (std::uint32_t t = 0; t < thread_count; ++t)
    threads.emplace_back([&, t] {
      start.arrive_and_wait();
      for (std::uint32_t s = samples; s-- > 0;)
        if (s % thread_count == t) deposit(together, s);
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(forward.hash(), together.hash());
}

TEST(FilmMerge, IsCommutativeAndAssociative) {
  Film a = film_of(1), b = film_of(1), c = film_of(1);
  fill(a, 5, 1), fill(b, 8, 2), fill(c, 3, 3);
  EXPECT_EQ(sum(a, b).hash(), sum(b, a).hash());
  EXPECT_EQ(sum(sum(a, b), c).hash(), sum(a, sum(b, c)).hash());
  EXPECT_NE(sum(a, b).hash(), a.hash());
}

TEST(FilmMerge, MeansOfSeedsAreExactInAnyOrder) {
  Film a = film_of(1), b = film_of(2), c = film_of(3);
  fill(a, 5, 1), fill(b, 3, 2), fill(c, 1, 3);
  const Film forward = sum(sum(a, b), c), backward = sum(sum(c, b), a);
  for (std::uint32_t p = 0; p < a.counts().size(); ++p) EXPECT_EQ(forward.mean(p), backward.mean(p));
}

TEST(FilmMerge, RefusesStrangers) {
  Film film = film_of(1);
  EXPECT_THROW(film.merge(film_of(1, 3, 4)), Error);
  EXPECT_THROW(film.merge(Film(settings(4, 3), {9, 2, 1})), Error);
  EXPECT_THROW(film.merge(Film(settings(4, 3), {1, 9, 1})), Error);
}

// Over many pixels the estimate averages to σ²/n, whatever n is to the number of groups.
TEST(FilmVariance, IsUnbiased) {
  for (const std::uint32_t n : {2u, 5u, 8u, 13u, 64u}) {
    Film film = film_of(1, 100, 100);
    fill(film, n, n, 5, 2);
    double mean = 0;
    for (std::uint32_t p = 0; p < 10000; ++p) mean += film.variance_of_mean(p) / 10000;
    EXPECT_NEAR(mean * n / 4, 1, 0.06) << n;  // relative σ of the mean of 10⁴ estimates: ≤ √2/100
  }
}

TEST(FilmVariance, OfMergedSeedsIsUnbiased) {
  Film film = film_of(0, 100, 100);
  fill(film, 3, 100, 5, 2);
  for (std::uint64_t seed = 1; seed < 4; ++seed) {
    Film other = film_of(seed, 100, 100);
    fill(other, 3, static_cast<unsigned>(100 + seed), 5, 2);
    film.merge(other);
  }
  double mean = 0;
  for (std::uint32_t p = 0; p < 10000; ++p) mean += film.variance_of_mean(p) / 10000;
  EXPECT_NEAR(mean * 12 / 4, 1, 0.06);
}

TEST(FilmVariance, IsZeroWhereItCannotBeKnown) {
  Film film = film_of(1);
  EXPECT_EQ(film.variance_of_mean(0), 0);
  fill(film, 1, 1);
  EXPECT_EQ(film.variance_of_mean(0), 0);
}

TEST(Film, RefusesAnEmptyCrop) {
  FilmSettings s = settings(4, 4);
  s.crop = {2, 2, 0, 4};
  EXPECT_THROW(Film(s, {}), Error);
  s.crop = {0, 5, 0, 4};
  EXPECT_THROW(Film(s, {}), Error);
}

TEST(Develop, WhiteIsWhite) {
  Film film = film_of(1, 1, 1);
  film.count_sample(0);
  ASSERT_TRUE(film.deposit(0, 0, srgb_to_xyz({1, 1, 1})));
  Picture picture = develop(film);
  for (const float v : picture.rgb.values) EXPECT_NEAR(v, 1, 1e-6);
  expose(picture, 2);
  for (const float v : picture.rgb.values) EXPECT_NEAR(v, 4, 4e-6);
}

}  // namespace
}  // namespace vitrail
