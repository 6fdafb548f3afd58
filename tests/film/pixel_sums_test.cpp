// SPDX-License-Identifier: Apache-2.0
#include "film/pixel_sums.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <thread>
#include <vector>

namespace vitrail::pixel_sums_test {
namespace {

FilmSettings crop_of_a_picture() {
  FilmSettings s;
  s.width = 9, s.height = 7;
  s.crop = {3, 8, 2, 6};
  return s;
}

// A sample of a pixel and what it adds.
struct Added {
  std::uint32_t pixel, sample;
  XYZ value;
};

// Runs of one pixel, mostly, as tiles have them; a part is negative, a part below a quantum.
std::vector<Added> some_deposits(std::uint32_t pixels, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.5, 1);
  std::vector<Added> all;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    const double size = i % 5 == 0 ? 0x1p-47 : 1;
    const auto pixel = static_cast<std::uint32_t>(random() % 8 == 0 ? random() : i / 16) % pixels;
    all.push_back({pixel, i, {size * normal(random), size * normal(random), size * normal(random)}});
  }
  return all;
}

TEST(PixelSums, GiveTheFilmWhatItsDepositsGiveIt) {
  for (const std::uint64_t seed : {0, 1}) {
    Film direct(crop_of_a_picture(), {1, seed}), gathered(crop_of_a_picture(), {1, seed});
    ASSERT_TRUE(PixelSums::is_plain(gathered));
    {
      PixelSums sums(gathered);
      for (const auto& [pixel, sample, value] : some_deposits(direct.pixels(), 7)) {
        direct.count_sample(pixel, sample);
        EXPECT_TRUE(direct.deposit(pixel, sample, value));
        sums.count_sample(pixel, sample);
        EXPECT_TRUE(sums.deposit(pixel, sample, value));
      }
    }
    EXPECT_GT(direct.samples(0), 0u);
    EXPECT_EQ(gathered.hash(), direct.hash());
  }
}

TEST(PixelSums, OfSeveralThreadsMeetInTheFilm) {
  Film direct(crop_of_a_picture(), {}), gathered(crop_of_a_picture(), {});
  std::vector<std::jthread> threads;
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    for (const auto& [pixel, sample, value] : some_deposits(direct.pixels(), seed))
      direct.deposit(pixel, sample, value);
    threads.emplace_back([&gathered, seed] {
      PixelSums sums(gathered);
      for (const auto& [pixel, sample, value] : some_deposits(gathered.pixels(), seed))
        sums.deposit(pixel, sample, value);
    });
  }
  threads.clear();
  EXPECT_EQ(gathered.hash(), direct.hash());
}

TEST(PixelSums, RefuseWhatTheFilmRefuses) {
  Film film(crop_of_a_picture(), {});
  {
    PixelSums sums(film);
    EXPECT_FALSE(sums.deposit(0, 0, {1, std::numeric_limits<double>::quiet_NaN(), 1}));
    EXPECT_FALSE(sums.deposit(0, 0, {1, 0x1p60, 1}));
    EXPECT_TRUE(sums.deposit(0, 0, {1, 2, 3}));
  }
  EXPECT_EQ(film.refused(), (Refused{.nonfinite = 1, .too_large = 1}));
  EXPECT_FALSE(film.sums()[0] == WideSum{});
}

TEST(PixelSums, LeaveOtherFilmsAlone) {
  FilmKey splats, photons;
  splats.splats = true;
  photons.photons.photons = 10;
  EXPECT_FALSE(PixelSums::is_plain(Film(crop_of_a_picture(), splats)));
  EXPECT_FALSE(PixelSums::is_plain(Film(crop_of_a_picture(), photons)));
}

}  // namespace
}  // namespace vitrail::pixel_sums_test
