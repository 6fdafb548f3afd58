// SPDX-License-Identifier: Apache-2.0
// Welch's t-test of each tile asks whether two renders have the same expectation (Jung, Hanika & Dachsbacher
// 2020, "Detecting Bias in Monte Carlo Renderers using Welch's t-test"). Where nothing differs, p-values are
// spread evenly over [0,1]; where something does, they crowd near 0, in the tiles where it does.
//
// A film knows each pixel's variance by two groups of samples alone, so tiles are tested, not pixels. With 64
// pixels each film brings 64 degrees of freedom, and the means of a tile are nearly normal.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

inline constexpr int welch_tile = 8;  // pixels a side
// One of so many pairs of renders with the same expectation is called different.
inline constexpr double welch_significance = 1e-4;

// A WelchPicture is a picture with each pixel's variance of its mean luminance, of one degree of freedom.
struct WelchPicture {
  const Image* image = nullptr;
  const Image* variance = nullptr;
  double neighbours_of_mean = 1, neighbours_of_variances = 1;  // film/neighbours.h
};

// A WelchTest holds what the test found.
struct WelchTest {
  std::vector<double> p_values;  // of tiles, row by row; NaN where no pixel is finite in both
  std::size_t columns = 0, tested = 0;
  std::array<std::size_t, 10> histogram{};  // of p-values, by tenths
  // Kolmogorov and Smirnov's distance is the most that the share of p-values up to p differs from p. The
  // second number is the distance that is allowed at welch_significance.
  double distance = 0, allowed_distance = 0;
};

// Tests luminance. The pictures are of one size; a tile at the right or bottom border is smaller.
WelchTest welch_test(const WelchPicture& a, const WelchPicture& b);

// Returns a map with 1 − p of its tile in each pixel.
std::vector<double> welch_map(const WelchTest& test, int width, int height);

}  // namespace vitrail
