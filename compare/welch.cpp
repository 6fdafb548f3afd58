// SPDX-License-Identifier: Apache-2.0
#include "compare/welch.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compare/metrics.h"
#include "compare/ztest.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

double luminance_of(const Image& image, std::size_t p) {
  const float* c = &image.values[3 * p];
  return srgb_to_xyz({static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])}).y;
}

// Of one picture in a tile: sums over its pixels of luminances, of variances and of their squares.
struct TileSums {
  double luminance = 0, variance = 0, squares = 0;

  void add(const WelchPicture& picture, std::size_t p) {
    const double v = static_cast<double>(picture.variance->values[p]);
    luminance += luminance_of(*picture.image, p);
    variance += v;
    squares += v * v;
  }
  double variance_of_sum(const WelchPicture& picture) const { return picture.neighbours_of_mean * variance; }
  // Of a sum of independent estimates of one degree of freedom, (Σσ²)²/Σσ⁴ (Satterthwaite 1946), where
  // E[v²] = 3σ⁴ and E[(Σv)²] = (Σσ²)² + 2Σσ⁴.
  double degrees_of_freedom(const WelchPicture& picture) const {
    if (squares == 0) return 1;
    return std::max(1.0, (3 * variance * variance / squares - 2) / picture.neighbours_of_variances);
  }
};

double p_value(const WelchPicture& a, const WelchPicture& b, const TileSums& of_a, const TileSums& of_b) {
  const double difference = of_a.luminance - of_b.luminance;
  if (difference == 0) return 1;
  const double va = of_a.variance_of_sum(a), vb = of_b.variance_of_sum(b);
  if (va + vb == 0) return 0;
  const double freedom =
      (va + vb) * (va + vb) / (va * va / of_a.degrees_of_freedom(a) + vb * vb / of_b.degrees_of_freedom(b));
  return two_sided_p(difference / std::sqrt(va + vb), std::max(1, static_cast<int>(std::floor(freedom))));
}

void judge(WelchTest& test) {
  std::vector<double> sorted;
  std::ranges::copy_if(test.p_values, std::back_inserter(sorted), [](double p) { return !std::isnan(p); });
  std::ranges::sort(sorted);
  test.tested = sorted.size();
  const auto count = static_cast<double>(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    ++test.histogram[std::min<std::size_t>(9, static_cast<std::size_t>(10 * sorted[i]))];
    const auto below = static_cast<double>(i);
    test.distance = std::max({test.distance, sorted[i] - below / count, (below + 1) / count - sorted[i]});
  }
  // P(D > d) ≈ 2 exp(−2 n d²)
  test.allowed_distance = std::sqrt(std::log(2 / welch_significance) / (2 * std::max(1.0, count)));
}

}  // namespace

WelchTest welch_test(const WelchPicture& a, const WelchPicture& b) {
  require_same_size(*a.image, *b.image);
  const int width = a.image->width, height = a.image->height;
  WelchTest test;
  test.columns = static_cast<std::size_t>((width + welch_tile - 1) / welch_tile);
  for (int y = 0; y < height; y += welch_tile)
    for (int x = 0; x < width; x += welch_tile) {
      TileSums of_a, of_b;
      bool any = false;
      for (int j = y; j < std::min(height, y + welch_tile); ++j)
        for (int i = x; i < std::min(width, x + welch_tile); ++i) {
          const std::size_t p =
              static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
          if (!std::isfinite(luminance_of(*a.image, p)) || !std::isfinite(luminance_of(*b.image, p)))
            continue;
          of_a.add(a, p), of_b.add(b, p);
          any = true;
        }
      test.p_values.push_back(any ? p_value(a, b, of_a, of_b) : std::nan(""));
    }
  judge(test);
  return test;
}

std::vector<double> welch_map(const WelchTest& test, int width, int height) {
  std::vector<double> map;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      map.push_back(1 - test.p_values[static_cast<std::size_t>(y / welch_tile) * test.columns +
                                      static_cast<std::size_t>(x / welch_tile)]);
  return map;
}

}  // namespace vitrail
