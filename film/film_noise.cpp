// SPDX-License-Identifier: Apache-2.0
#include "film/film_noise.h"

#include <algorithm>
#include <cmath>

#include "scene/records/pixel_place.h"

namespace vitrail {

namespace {

// The greatest Y of the eight pixels around; 0 where there is none.
double greatest_around(const Film& film, int x, int y) {
  double greatest = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, film.height() - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, film.width() - 1); ++i)
      if (i != x || j != y)
        greatest =
            std::max(greatest, film.mean(static_cast<std::uint32_t>(pixel_place(i, j, film.width()))).y);
  return greatest;
}

// Y² of the pixel to divide its squared error by. With a and b the means of the two groups it is ab, which
// knows nothing of their difference: where one alone has found something bright, the pixel is as dark as the
// other says. And it is no more than the greatest of the pixels around.
double square_without_specks(double own, double variance, double around) {
  return std::min(std::max(0.0, own * own - variance), around * around);
}

// Of the squared error, what a pixel would have of something as bright as the brightest beside it that its
// samples missed: half a sample's worth of it (Krichevsky & Trofimov 1981), which is the expected number
// where none was found, in one of two such pixels: the edge runs through one of two that meet there. The
// estimate does not have it.
double unseen(double own, double around, double samples) {
  const double of_a_sample = std::max(0.0, around - own) / samples;
  return 0.5 * (0.5 * of_a_sample) * (0.5 * of_a_sample);
}

// `weight(Y²)`: of a squared error at that luminance.
template <class Weight>
NoiseEstimate weighted(const Film& film, Weight weight) {
  const bool single = film.pixels() == 1;
  double sum = 0, squares = 0;
  std::uint32_t noisy = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const auto pixel = static_cast<std::uint32_t>(pixel_place(x, y, film.width()));
      if (film.samples(pixel) == 0) continue;
      const double own = film.mean(pixel).y, variance = film.variance_of_mean(pixel),
                   around = single ? own : greatest_around(film, x, y),
                   each = weight(square_without_specks(own, variance, around)), error = variance * each,
                   missed = each * unseen(own, around, static_cast<double>(film.samples(pixel)));
      sum += error;
      noisy += error > 0;
      // Twice: the error that the film has is as far from its expectation as the estimate is.
      squares += 2 * error * error + missed * missed;
    }
  const double n = film.pixels(), mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - 2 * mean * mean) / n), noisy};
}

// Student's t of n degrees of freedom that is exceeded in 3 % of cases: by Fisher and Cornish's series (1960;
// Abramowitz & Stegun 1964, 26.7.5) from four degrees on, to 0.3 %.
double student_quantile(double n) {
  constexpr double few[] = {10.579, 3.896, 2.951}, z = 1.8808, z2 = z * z;
  if (n < 4) return few[static_cast<int>(n) - 1];
  const double first = z * (z2 + 1) / 4, second = z * ((5 * z2 + 16) * z2 + 3) / 96,
               third = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
  return z + (first + (second + third / n) / n) / n;
}

// What the ratio of two independent χ² of n degrees of freedom exceeds as seldom: (t/√n + √(1 + t²/n))²
// (Cacoullos, "A relation between t and F-distributions", 1965).
double ratio_quantile(double n) {
  const double s = student_quantile(n) / std::sqrt(n), root = s + std::sqrt(1 + s * s);
  return root * root;
}

// Newton's; the C library's cube root depends on the machine. `v` in [0.008, 1].
double cube_root(double v) {
  double r = 0.3 + 0.7 * v;
  for (int i = 0; i < 6; ++i) r -= (r - v / (r * r)) / 3;
  return r;
}

}  // namespace

double NoiseEstimate::upper() const {
  if (noisy_pixels == 0) return mean + 2.33 * standard_error;
  return std::max(mean + 2.33 * standard_error, mean * ratio_quantile(noisy_pixels));
}

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
