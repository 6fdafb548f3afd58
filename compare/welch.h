// SPDX-License-Identifier: Apache-2.0
// Do two renders have the same expectation? Welch's t-test of each tile (Jung, Hanika & Dachsbacher 2020,
// "Detecting Bias in Monte Carlo Renderers using Welch's t-test"). Where nothing differs, p-values are spread
// evenly over [0,1]; where something does, they crowd near 0, in the tiles where it does.
//
// A film knows each pixel's variance by two groups of samples alone, so tiles are tested, not pixels: with
// 64 pixels each film brings 64 degrees of freedom, and the means of a tile are nearly normal.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

inline constexpr int welch_tile = 8;  // pixels a side
// Of so many pairs of renders with the same expectation one is called different.
inline constexpr double welch_significance = 1e-4;

// A picture, and for each pixel the variance of its mean luminance, with one degree of freedom.
struct WelchPicture {
  const Image* image = nullptr;
  const Image* variance = nullptr;
  double neighbours_of_mean = 1, neighbours_of_variances = 1;  // film/neighbours.h
};

// What the test found.
struct WelchTest {
  std::vector<double> p_values;  // of tiles, row by row; NaN where no pixel is finite in both
  std::size_t columns = 0, tested = 0;
  std::array<std::size_t, 10> histogram{};  // of p-values, by tenths
  // Kolmogorov and Smirnov's: how far the share of p-values up to some p is from p at most, and by how much
  // it may be at welch_significance.
  double distance = 0, allowed_distance = 0;
};

// Of luminance. The pictures are of one size; a tile at the right or bottom border is smaller.
WelchTest welch_test(const WelchPicture& a, const WelchPicture& b);

// 1 − p in each pixel of the tile.
std::vector<double> welch_map(const WelchTest& test, int width, int height);

}  // namespace vitrail
