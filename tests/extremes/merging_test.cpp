// SPDX-License-Identifier: Apache-2.0
// A thousand million samples a pixel, in films that are merged.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "film/film_progress.h"
#include "film/image_io.h"
#include "tests/extremes/measure.h"
#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::merging_test {
namespace {

FilmSettings pixels(int width) {
  FilmSettings s;
  s.width = width, s.height = 1;
  s.crop = {0, width, 0, 1};
  return s;
}

constexpr std::uint32_t base_samples = 1000;
constexpr int doublings = 20;  // 1.05·10⁹ samples

// One pixel a mean: n samples of Y = mean·(1 ± 1/2), X = Y/2, Z = 2Y.
Film film_of(std::uint64_t seed, const std::vector<double>& means, std::vector<long double>& sums) {
  Film film(pixels(static_cast<int>(means.size())), {.scene_hash = 1, .seed = seed});
  std::mt19937_64 random(seed);
  for (std::uint32_t p = 0; p < means.size(); ++p)
    for (std::uint32_t s = 0; s < base_samples; ++s) {
      const double y = means[p] * (0.5 + static_cast<double>(random() >> 11) * 0x1p-53);
      film.count_sample(p, s);
      EXPECT_TRUE(film.deposit(p, s, {y / 2, y, 2 * y}));
      sums[p] += static_cast<long double>(y);
    }
  return film;
}

// The same sums as of other samples.
Film of_seed(const Film& film, std::uint64_t seed, int width) {
  Film copy(pixels(width), {.scene_hash = 1, .seed = seed});
  copy.merge(film);
  return copy;
}

const std::vector<double> means{1e-6, 1e-4, 0.01, 0.3, 1e3, 1e10};

Film merged(std::vector<long double>& sums) {
  const auto width = static_cast<int>(means.size());
  Film film = film_of(1, means, sums);
  for (int i = 0; i < doublings; ++i) film.merge(of_seed(film, static_cast<std::uint64_t>(i) + 2, width));
  return film;
}

TEST(Merging, AThousandMillionSamples) {
  std::vector<long double> sums(means.size());
  const Film film = merged(sums);
  expect_exactly("samples a pixel after 20 doublings",
                 static_cast<double>(base_samples) * std::exp2(doublings),
                 static_cast<double>(film.samples(0)));
  expect_exactly("saturated", 0, film.saturated());
  for (std::uint32_t p = 0; p < means.size(); ++p) {
    const auto expected = static_cast<double>(sums[p] / base_samples);
    expect_relative(fmt::format("mean of 10⁹ samples of {:g}", means[p]), expected, film.mean(p).y, 2e-6);
    // Of copies of the same samples no estimate is right: it is finite and not negative.
    const double variance = film.variance_of_mean(p);
    EXPECT_TRUE(std::isfinite(variance) && variance >= 0) << means[p];
  }
  EXPECT_NO_THROW(develop(film));
}

// Counts have 32 bits, or as many for each of a few groups of samples.
TEST(Merging, MoreThanCountsHoldIsRefused) {
  std::vector<long double> sums(means.size());
  Film film = merged(sums);
  const auto width = static_cast<int>(means.size());
  int more = 0;
  EXPECT_THROW(
      for (; more < 10; ++more) film.merge(of_seed(film, 100 + static_cast<std::uint64_t>(more), width)),
      Error);
  EXPECT_GE(more, 2);
  report("samples a pixel, then one more doubling is refused", static_cast<double>(film.samples(0)));
}

// Through files and the program.
TEST(Merging, ByDevelop) {
  std::vector<long double> sums(means.size());
  const TemporaryDirectory directory;
  const auto width = static_cast<int>(means.size());
  Film part = film_of(1, means, sums);
  for (int i = 0; i < doublings - 2; ++i) part.merge(of_seed(part, static_cast<std::uint64_t>(i) + 2, width));
  std::string files;
  for (std::uint64_t i = 0; i < 4; ++i) {
    const auto file = directory / fmt::format("{}.film", i);
    write_film(file, of_seed(part, 1000 + i, width), FilmProgress{});
    files += " '" + file.string() + "'";
  }
  const auto image = directory / "all.exr";
  const CommandResult result = run(vitrail("develop") + files + " -o '" + image.string() + "'");
  ASSERT_EQ(result.status, 0) << result.output;
  const Picture picture = read_picture(image);
  for (std::size_t p = 0; p < means.size(); ++p) {
    const double y = static_cast<double>(sums[p] / base_samples);
    expect_relative(fmt::format("10⁹ samples of {:g} by `vitrail develop`: green", means[p]),
                    xyz_to_srgb({y / 2, y, 2 * y}).g, static_cast<double>(picture.rgb.values[3 * p + 1]),
                    2e-6);
  }
}

}  // namespace
}  // namespace vitrail::test::merging_test
