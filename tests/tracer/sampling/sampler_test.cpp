// SPDX-License-Identifier: Apache-2.0
#include "tracer/sampling/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "film/sample_groups.h"

namespace vitrail::sampler_test {
namespace {

// Point i of a group's sequence.
std::array<float, 4> point(std::uint64_t seed, std::uint32_t pixel, std::uint32_t group, std::uint32_t i,
                           std::uint32_t set) {
  return sample_4d({seed, pixel, i * sample_groups + group}, set);
}

// The first 2ᵏ samples of a group fall, in each dimension, one into each of 2ᵏ equal intervals, whatever the
// scramble.
TEST(Sampler, EveryDimensionIsStratified) {
  for (const std::uint32_t count : {16u, 256u, 1024u})
    for (std::uint32_t set = 0; set < 5; ++set)
      for (std::size_t d = 0; d < 4; ++d) {
        std::vector<int> hits(count);
        for (std::uint32_t i = 0; i < count; ++i) {
          const float u = point(42, 7, set % sample_groups, i, set)[d];
          ASSERT_GE(u, 0);
          ASSERT_LT(u, 1);
          ++hits[static_cast<std::size_t>(u * static_cast<float>(count))];
        }
        EXPECT_TRUE(std::ranges::all_of(hits, [](int n) { return n == 1; }))
            << "set " << set << " dimension " << d;
      }
}

// Dimensions 0 and 1 form a (0,2)-sequence: one of the first 256 points in each cell of every 2ᵃ × 2ᵇ grid, a
// + b = 8.
TEST(Sampler, FirstPairIsANet) {
  for (int a = 0; a <= 8; ++a) {
    std::vector<int> hits(256);
    for (std::uint32_t i = 0; i < 256; ++i) {
      const auto u = point(1, 99, 1, i, 3);
      const auto x = static_cast<std::size_t>(u[0] * static_cast<float>(1 << a));
      const auto y = static_cast<std::size_t>(u[1] * static_cast<float>(1 << (8 - a)));
      ++hits[x << (8 - a) | y];
    }
    EXPECT_TRUE(std::ranges::all_of(hits, [](int n) { return n == 1; })) << a;
  }
}

// Of one sequence all samples of a pixel are that: each 2ᵏ from the first on fill every cell of their grids,
// whatever their parity, as those of a group do else.
TEST(Sampler, OneSequenceIsANetOfAllSamples) {
  for (const bool one : {true, false}) {
    bool is_net = true;
    for (int m = 0; m <= 8; ++m)
      for (int a = 0; a <= m; ++a) {
        std::vector<int> hits(std::size_t{1} << m);
        for (std::uint32_t i = 0; i < hits.size(); ++i) {
          const auto u = sample_4d({{11, one}, 5, i}, 2);
          const auto x = static_cast<std::size_t>(u[0] * static_cast<float>(1 << a));
          const auto y = static_cast<std::size_t>(u[1] * static_cast<float>(1 << (m - a)));
          ++hits[x << (m - a) | y];
        }
        is_net = is_net && std::ranges::all_of(hits, [](int n) { return n == 1; });
      }
    EXPECT_EQ(is_net, one);
  }
}

// Pixels, seeds, sets and groups are independent: correlations vanish within 5 standard errors.
TEST(Sampler, StreamsAreUncorrelated) {
  constexpr int n = 20000;
  const auto correlation = [&](auto first, auto second) {
    double sum = 0;
    for (std::uint32_t i = 0; i < n; ++i) sum += (first(i) - 0.5) * (second(i) - 0.5);
    return sum / n * 12;
  };
  const auto u = [](std::uint64_t seed, std::uint32_t set) {
    return [=](std::uint32_t i) { return static_cast<double>(sample_4d({seed, i, 5}, set)[0]); };
  };
  const double limit = 5 / std::sqrt(static_cast<double>(n));
  EXPECT_LT(std::abs(correlation(u(0, 0), u(0, 1))), limit);
  EXPECT_LT(std::abs(correlation(u(0, 0), u(1, 0))), limit);
  const auto other_group = [](std::uint32_t i) { return static_cast<double>(sample_4d({0, i, 4}, 0)[0]); };
  EXPECT_LT(std::abs(correlation(u(0, 0), other_group)), limit);
  const auto neighbour = [](std::uint32_t i) { return static_cast<double>(sample_4d({0, i + 1, 5}, 0)[0]); };
  EXPECT_LT(std::abs(correlation(u(0, 0), neighbour)), limit);
}

// A smooth integral converges far faster than with independent samples.
TEST(Sampler, ConvergesFasterThanChance) {
  double error = 0;
  for (std::uint32_t pixel = 0; pixel < 64; ++pixel) {
    double mean = 0;
    for (std::uint32_t i = 0; i < 256; ++i) {
      const auto u = point(0, pixel, 0, i, 1);
      mean += std::sin(3.0 * u[0]) * u[1] * (1 + u[2] * u[3]) / 256;
    }
    const double exact = (1 - std::cos(3.0)) / 3 * 0.5 * 1.25;
    error += (mean - exact) * (mean - exact) / 64;
  }
  // Independent samples would have a variance of about 0.09 / 256.
  EXPECT_LT(error, 0.09 / 256 / 20);
}

// The means of two groups err independently: those of one sequence dealt out in turn would err against each
// other, and their difference by much more than their sum.
TEST(Sampler, GroupsErrIndependently) {
  constexpr int pixels = 4000;
  double sums = 0, differences = 0;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    std::array<double, 2> mean{};
    for (std::uint32_t i = 0; i < 32; ++i) {
      const auto u = sample_4d({3, pixel, i}, 1);
      mean[group_of(i)] += (u[0] * u[1] - 0.25) / 16;
    }
    sums += (mean[0] + mean[1]) * (mean[0] + mean[1]);
    differences += (mean[0] - mean[1]) * (mean[0] - mean[1]);
  }
  EXPECT_NEAR(differences / sums, 1, 5 * 2 / std::sqrt(static_cast<double>(pixels)));  // σ of F(n, n) is 2/√n
}

}  // namespace
}  // namespace vitrail::sampler_test
