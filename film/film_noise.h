// SPDX-License-Identifier: Apache-2.0
// Film noise is how far a film is from its limit of infinitely many samples, by its two groups of samples. It
// sums many pixels: the variance of one has a single degree of freedom. Every machine gets the same bits.
#pragma once

#include "film/film.h"

namespace vitrail {

// It prevents division by black, as in compare's relmse (after Rousselle, Knaus, Zwicker 2011).
inline constexpr double relative_error_floor = 0.01;

// A NoiseEstimate is a mean over pixels. The standard error is that of the difference between the estimate
// and the film's real error, which scatters as much as the estimate. It includes what a pixel may have missed
// of something as bright as the brightest pixel beside it. That is half a sample of it (Krichevsky & Trofimov
// 1981), in one of two such pixels.
struct NoiseEstimate {
  double mean = 0, standard_error = 0;
  std::uint32_t noisy_pixels = 0;  // whose two groups differ
  // The true error is below upper() with a probability of 99 % at one look. Over several looks, with errors
  // as skewed as those of pictures, it is nine times in ten. Few pixels say little of their own scatter: of n
  // alike, true error and estimate are two independent χ² of n degrees of freedom. So the bound is at least
  // what their ratio exceeds in 3 % of cases.
  double upper() const;
};

// An estimate is looked at after at least so many samples in all. Of few samples, the two groups of a pixel
// may agree by chance, and each further look is another chance to end too soon.
inline constexpr std::uint32_t least_samples_of_estimate = 1024;

// Returns the mean of (Y − Y∞)²/(Y∞² + 0.01) over the pixels. The denominator uses the product of
// the pixel's two groups, or the greatest of the eight pixels around if that is less. A bright
// speck would else divide by itself.
NoiseEstimate relative_squared_error(const Film& film);

// Returns the same in just noticeable differences: the mean of (ΔL*/2.3)², where L* is CIELAB's lightness of
// Y as shown without exposure, white at 1, brighter light no brighter. 2.3 units of ΔE*ab are just noticeable
// (Mahy, Van Eycken, Oosterlinck 1994).
NoiseEstimate displayed_squared_error(const Film& film);

}  // namespace vitrail
