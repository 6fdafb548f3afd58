// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <gtest/gtest.h>

#include <barrier>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <thread>

#include "film/develop.h"
#include "scene/records/film_extent.h"
#include "scene/records/pixel_place.h"
#include "scene/system/diagnostics.h"

namespace vitrail::film_test {
namespace {

FilmSettings settings(int width, int height) {
  FilmSettings s;
  s.width = width, s.height = height;
  s.crop = {0, width, 0, height};
  return s;
}

Film film_of(std::uint64_t seed, int width = 4, int height = 3, int exponent = default_exponent) {
  return Film(settings(width, height), {1, seed}, exponent);
}

// n samples a pixel, of luminance μ + σ·(normal).
void fill(Film& film, std::uint32_t n, unsigned random_seed, double mu = 5, double sigma = 1) {
  std::mt19937 random(random_seed);
  std::normal_distribution<double> normal(mu, sigma);
  for (std::uint32_t p = 0; p < film.pixels(); ++p)
    for (std::uint32_t s = 0; s < n; ++s) {
      const double y = normal(random);
      film.count_sample(p, s);
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
  for (std::uint32_t i = 0; i < 4; ++i) film.count_sample(1, i);
  ASSERT_TRUE(film.deposit(1, 0, {1, 2, 3}));
  ASSERT_TRUE(film.deposit(1, 2, {1, -2, 5}));
  ASSERT_TRUE(film.deposit(1, 3, {0, 4, 0}));
  EXPECT_EQ(film.mean(1), (XYZ{1.5, 3, 6}));
  EXPECT_EQ(film.mean(0), XYZ{});
  EXPECT_EQ(film.samples(1), 4u);
}

// More pixels than an int counts: 65535² are.
TEST(Film, CountsPixelsBeyondAnInt) {
  constexpr int side = 65535;
  static_assert(pixel_place(side - 1, side - 1, side) == 4'294'836'224u);
  static_assert(pixel_place(0, 40'000, side) == 2'621'400'000u);
  const FilmSettings s = settings(side, side);
  EXPECT_GT(film_bytes(s), 4'294'836'225u * 4 * sizeof(WideSum));
  EXPECT_THROW(film_bytes(settings(side + 1, side + 1)), Error);
  FilmSettings part = settings(max_film_extent, max_film_extent);
  part.crop = {max_film_extent - 8, max_film_extent, max_film_extent - 8, max_film_extent};
  EXPECT_EQ(Film(part, {}).pixels(), 64u);
  part.width = max_film_extent + 1;
  EXPECT_THROW(film_bytes(part), Error);
}

TEST(Film, ClampsDepositsAndKnowsWhatItTook) {
  FilmSettings s = settings(2, 1);
  s.imaging_ratio = 2;
  FilmKey key;
  key.clamp = 10;
  Film film(s, key);
  EXPECT_EQ(film.clamped_share(), 0);
  const auto deposit = [&](const XYZ& v) {
    const double left = film.clamp(1, 0, v);
    ASSERT_TRUE(film.deposit(1, 0, {left * v.x, left * v.y, left * v.z}));
  };
  film.count_sample(1, 0);
  deposit({1, 3, 2});    // 6 of 10
  deposit({4, 20, 40});  // an eighth is left
  EXPECT_EQ(film.mean(1), (XYZ{2 * 1.5, 2 * 5.5, 2 * 7}));
  EXPECT_DOUBLE_EQ(film.clamped_share(), 17.5 / 23);
  Film other(s, key);
  other.merge(film);
  EXPECT_EQ(other.clamped_share(), film.clamped_share());
  key.clamp = 11;
  EXPECT_THROW(Film(s, key).merge(film), Error);
  EXPECT_EQ(Film(s, FilmKey{}).clamp(0, 0, {1e9, 1e9, 1e9}), 1);
}

// Whole numbers of quanta exactly; what is between two of them as either, and right on the average.
// What all pixels of a batch of iterations have in common: ±0.1 from batch to batch, and as much in each
// pixel, whose own scatter knows nothing of it.
TEST(Film, OfPhotonsKnowsTheErrorThatPixelsShare) {
  const FilmKey key{.scene_hash = 1, .photons = {100, 0.1, 0.5}};
  Film film(settings(4, 3), key), other(settings(4, 3), key), paths = film_of(0);
  EXPECT_EQ(film.shared_error(), 0) << "of nothing";
  constexpr std::uint32_t batches = 8;
  for (std::uint32_t i = 0; i < batches * iterations_a_batch; ++i)
    for (std::uint32_t p = 0; p < film.pixels(); ++p)
      for (Film* f : {i % 3 == 0 ? &film : &other, &paths}) {
        f->count_sample(p, i);
        ASSERT_TRUE(f->deposit(p, i, {0, batch_of(i) % 2 == 0 ? 1.1 : 0.9, 0}));
      }
  film.merge(other);
  EXPECT_NEAR(film.shared_error(), 0.1 / std::sqrt(batches - 1.0), 1e-9);
  EXPECT_EQ(paths.shared_error(), 0);
  EXPECT_EQ(develop(film).shared_error, film.shared_error());
}

TEST(Film, RoundsWithoutBias) {
  constexpr int n = 100000;
  for (const double quanta : {3.0, -2.0, 0.25, 0.001, -0.7, 1e6 + 0.5}) {
    Film film = film_of(1, 1, 1, 7);
    const XYZ value{128 * quanta, 128 * quanta, 128 * quanta};
    for (std::uint32_t s = 0; s < n; ++s) ASSERT_TRUE(film.deposit(0, s, value));
    const double share = quanta - std::floor(quanta);
    const double limit = 5 * std::sqrt(share * (1 - share) * n);  // σ of that many decisions
    EXPECT_NEAR(static_cast<double>(value_of(film.sums()[0])), n * quanta, limit) << quanta;
    EXPECT_NEAR(static_cast<double>(value_of(film.sums()[1])), n * quanta, limit) << quanta;
    double y = 0;
    for (std::size_t g = 0; g < sample_groups; ++g) y += static_cast<double>(value_of(film.sums()[2 + g]));
    EXPECT_NEAR(y, n * quanta, limit) << quanta;
  }
}

TEST(Film, RefusesWhatDoesNotFitAndAddsNothing) {
  Film film = film_of(1, 4, 3, -40);
  const std::uint64_t before = film.hash();
  const auto refused = [&](double bad) {
    EXPECT_FALSE(film.deposit(0, 0, {bad, 1, 1}));
    EXPECT_FALSE(film.deposit(0, 0, {1, bad, 1}));
    EXPECT_FALSE(film.deposit(0, 0, {1, 1, bad}));
  };
  refused(std::numeric_limits<double>::quiet_NaN());
  refused(-std::numeric_limits<double>::infinity());
  EXPECT_EQ(film.refused(), (Refused{6, 0}));
  EXPECT_FALSE(film.saturated());
  refused(0x1p45);
  refused(-0x1p45);
  refused(1e300);
  EXPECT_EQ(film.refused(), (Refused{6, 9}));
  EXPECT_EQ(film.hash(), before);
  EXPECT_TRUE(film.deposit(0, 0, {std::nextafter(0x1p45, 0), 1, 1}));
}

// Whether a deposit is refused does not depend on what is in the film already, and so on no number of ranks.
TEST(Film, RefusesByTheDepositAlone) {
  Film film = film_of(1, 1, 1, 0);
  const double most = std::nextafter(0x1p85, 0);
  for (std::uint32_t s = 0; s < 10000; ++s) ASSERT_TRUE(film.deposit(0, s, {most, -most, most}));
  EXPECT_FALSE(film.deposit(0, 0, {0x1p85, 0, 0}));
  EXPECT_EQ(sum(film, film).refused().too_large, 2u);
  for (std::uint32_t s = 0; s < 10000; ++s) film.count_sample(0, s);
  EXPECT_NEAR(film.mean(0).x / 0x1p85, 1, 1e-15);
  EXPECT_NEAR(film.mean(0).y / 0x1p85, -1, 1e-15);
  EXPECT_THROW(develop(film), Error);
}

// Sums of deposits of all sizes, both signs, against 128-bit integers; the mean against long double.
TEST(Film, SumsAsWideIntegersDo) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> size(-80, 84), part(1, 2);
  Film film = film_of(1, 1, 1, 0);
  Int128 x = 0;
  long double largest = 0, mean = 0;
  for (std::uint32_t s = 0; s < 4096; ++s) {
    const double v =
        std::floor(std::ldexp(part(random), static_cast<int>(size(random)))) * (random() % 2 ? 1 : -1);
    film.count_sample(0, s);
    ASSERT_TRUE(film.deposit(0, s, {v, v, 0}));
    x += static_cast<Int128>(v);
    mean += static_cast<long double>(v) / 4096;
    largest = std::max(largest, std::abs(static_cast<long double>(v)));
  }
  EXPECT_TRUE(value_of(film.sums()[0]) == x);
  EXPECT_NEAR(static_cast<double>(mean / largest), film.mean(0).x / static_cast<double>(largest), 1e-16);
  EXPECT_EQ(film.mean(0).y, film.mean(0).x);
}

// Radiances of every size come back, with a quantum chosen for them.
TEST(Film, HoldsEverySizeOfRadiance) {
  for (const double radiance : {1e-30, 1e-8, 1.0, 1e7, 2.5e8, 1e30}) {
    Film film = film_of(1, 1, 1, std::ilogb(radiance) - 45);
    for (std::uint32_t s = 0; s < 4096; ++s) {
      film.count_sample(0, s);
      ASSERT_TRUE(film.deposit(0, s, {radiance, radiance, radiance}));
    }
    EXPECT_NEAR(film.mean(0).y / radiance, 1, 1e-13);
    EXPECT_NEAR(film.mean(0).x / radiance, 1, 1e-13);
  }
}

TEST(Film, ThreadsAndOrderDoNotMatter) {
  constexpr std::uint32_t samples = 1000000, thread_count = 4;
  Film forward = film_of(1, 1, 1), together = film_of(1, 1, 1);
  const auto deposit = [](Film& film, std::uint32_t s) {
    film.count_sample(0, s);
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

TEST(FilmMerge, OfSeedsIsExactInAnyOrder) {
  Film a = film_of(1), b = film_of(2), c = film_of(3);
  fill(a, 5, 1), fill(b, 3, 2), fill(c, 1, 3);
  EXPECT_EQ(sum(sum(a, b), c).hash(), sum(sum(c, b), a).hash());
}

TEST(FilmMerge, RefusesStrangersAndSaysWhy) {
  const Film film = film_of(1);
  const auto differs = [&](const Film& other, const std::string& how) {
    EXPECT_EQ(difference(film, other), how);
    EXPECT_THROW(sum(film, other), Error);
  };
  EXPECT_EQ(difference(film, film_of(9)), "");
  differs(film_of(1, 3, 3), "their widths differ: 4 and 3");
  differs(Film(settings(4, 3), {9, 1}),
          "they differ in the scene, the state of its glass or the way to sample");
  differs(Film(settings(4, 3), {1, 2, 8}), "their depths differ: 0 and 8");
  differs(Film(settings(4, 3), {1, 2, 0, true}), "one has direct light only");
  differs(film_of(2, 4, 3, -50), "their sums count in different powers of two: -45 and -50");
  FilmKey older{1, 2};
  older.renderer = {"0.0.9", 7};
  const std::string what = difference(film, Film(settings(4, 3), older));
  EXPECT_NE(what.find("vitrail 0.0.9, pictures of revision 7"), std::string::npos) << what;
  EXPECT_NE(what.find(to_string(this_renderer())), std::string::npos) << what;
  FilmSettings brighter = settings(4, 3);
  brighter.imaging_ratio = 2;
  differs(Film(brighter, {1, 2}), "their imaging ratios differ: 1 and 2");
  FilmSettings encoded = settings(4, 3);
  encoded.working_gamma = 2.2;
  differs(Film(encoded, {1, 2}),
          "colours of one are added up in another space of a screen than those of the other");
}

// Over many pixels the estimate averages to σ²/n, whatever n is to the number of groups.
TEST(FilmVariance, IsUnbiased) {
  for (const std::uint32_t n : {2u, 3u, 5u, 8u, 13u, 64u}) {
    Film film = film_of(1, 100, 100);
    fill(film, n, n, 5, 2);
    double mean = 0;
    for (std::uint32_t p = 0; p < 10000; ++p) mean += film.variance_of_mean(p) / 10000;
    // relative σ of the mean of 10⁴ estimates: √2/100 for one degree of freedom
    EXPECT_NEAR(mean * n / 4, 1, 0.06) << n;
  }
}

// Stratified samples have sums whose variance is not proportional to their number. Here all of it is in one
// group: right where both have as many samples, and off by n₁/n₀ at most where one has more.
TEST(FilmVariance, OfGroupsThatDiffer) {
  for (const std::uint32_t n : {8u, 9u}) {
    Film film = film_of(0, 100, 100);
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    double squares = 0, estimates = 0;
    for (std::uint32_t p = 0; p < film.pixels(); ++p) {
      double mean = 0;
      for (std::uint32_t s = 0; s < n; ++s) {
        const double y = group_of(s) == 0 ? 5 + 3 * normal(random) : 5;
        mean += y / n;
        film.count_sample(p, s);
        ASSERT_TRUE(film.deposit(p, s, {y, y, y}));
      }
      squares += (mean - 5) * (mean - 5);
      estimates += film.variance_of_mean(p);
    }
    EXPECT_NEAR(estimates / squares, n == 8 ? 1 : 4.0 / 5, 0.001) << n;
  }
}

// Films of one sample each, of seeds that follow on each other, are spread over the groups.
TEST(FilmVariance, OfMergedSeedsIsUnbiased) {
  for (const std::uint32_t n : {1u, 3u}) {
    Film film = film_of(0, 100, 100);
    fill(film, n, 100, 5, 2);
    for (std::uint64_t seed = 1; seed < 7; ++seed) {
      Film other = film_of(seed, 100, 100);
      fill(other, n, static_cast<unsigned>(100 + seed), 5, 2);
      film.merge(other);
    }
    double mean = 0;
    for (std::uint32_t p = 0; p < 10000; ++p) mean += film.variance_of_mean(p) / 10000;
    EXPECT_NEAR(mean * 7 * n / 4, 1, 0.06) << n;
  }
}

// A run that was stopped holds whatever samples its ranks had done.
TEST(FilmVariance, OfAnySamplesIsUnbiased) {
  Film film = film_of(1, 100, 100);
  std::mt19937 random(8);
  std::normal_distribution<double> normal(5, 2);
  for (std::uint32_t p = 0; p < film.pixels(); ++p)
    for (const std::uint32_t s : {1u, 2u, 4u, 5u, 9u, 11u, 14u}) {
      const double y = normal(random);
      film.count_sample(p, s);
      ASSERT_TRUE(film.deposit(p, s, {y, y, y}));
    }
  double mean = 0;
  for (std::uint32_t p = 0; p < 10000; ++p) mean += film.variance_of_mean(p) / 10000;
  EXPECT_NEAR(mean * 7 / 4, 1, 0.06);
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
  film.count_sample(0, 0);
  ASSERT_TRUE(film.deposit(0, 0, srgb_to_xyz({1, 1, 1})));
  Picture picture = develop(film);
  for (const float v : picture.rgb.values) EXPECT_NEAR(v, 1, 1e-6);
  expose(picture, 2);
  for (const float v : picture.rgb.values) EXPECT_NEAR(v, 4, 4e-6);
}

}  // namespace
}  // namespace vitrail::film_test
