// SPDX-License-Identifier: Apache-2.0
#include "film/noise.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

// Y² of the pixel to divide its squared error by. With a and b the means of the two groups it is ab, which
// knows nothing of their difference: where one alone has found something bright, the pixel is as dark as the
// other says. And it is no more than the greatest of the pixels around.
double square_without_specks(const Film& film, int x, int y, double variance) {
  const auto luminance = [&](int i, int j) {
    return film.mean(static_cast<std::uint32_t>(j * film.width() + i)).y;
  };
  const double own = luminance(x, y), product = std::max(0.0, own * own - variance);
  double around = 0;
  bool any = false;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, film.height() - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, film.width() - 1); ++i)
      if (i != x || j != y) around = std::max(around, luminance(i, j)), any = true;
  return any ? std::min(product, around * around) : product;
}

// `weight(Y²)`: of a squared error at that luminance.
template <class Weight>
NoiseEstimate weighted(const Film& film, Weight weight) {
  double sum = 0, squares = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const auto pixel = static_cast<std::uint32_t>(y * film.width() + x);
      const double variance = film.variance_of_mean(pixel);
      const double error = variance > 0 ? variance * weight(square_without_specks(film, x, y, variance)) : 0;
      sum += error, squares += error * error;
    }
  const double n = film.pixels(), mean = sum / n;
  // Twice: the error that the film has is as far from its expectation as the estimate is.
  return {mean, std::sqrt(2 * std::max(0.0, squares / n - mean * mean) / n)};
}

// Newton's; the C library's cube root depends on the machine. `v` in [0.008, 1].
double cube_root(double v) {
  double r = 0.3 + 0.7 * v;
  for (int i = 0; i < 6; ++i) r -= (r - v / (r * r)) / 3;
  return r;
}

}  // namespace

NoiseEstimate relative_squared_error(const Film& film) {
  return weighted(film, [](double square) { return 1 / (square + relative_error_floor); });
}

// L* = 116 ∛Y − 16 above Y = (6/29)³, and 903.3 Y below (CIE 15:2004, 8.2.1.1): squares of its slope.
NoiseEstimate displayed_squared_error(const Film& film) {
  constexpr double just_noticeable = 2.3, linear_below = 216.0 / 24389, linear_slope = 24389.0 / 27;
  return weighted(film, [=](double square) {
    if (square >= 1) return 0.0;
    const double y = std::sqrt(square);
    const double root = cube_root(std::max(y, linear_below));
    const double slope = y > linear_below ? 116 / (3 * root * root) : linear_slope;
    return slope * slope / (just_noticeable * just_noticeable);
  });
}

}  // namespace vitrail
