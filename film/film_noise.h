// SPDX-License-Identifier: Apache-2.0
// How far a film is from its limit of infinitely many samples, by what its two groups of samples say. Sums of
// many pixels: the variance of one is known with a single degree of freedom. The same bits on every machine.
#pragma once

#include "film/film.h"

namespace vitrail {

// Against division by black: compare's of relmse (after Rousselle, Knaus, Zwicker 2011).
inline constexpr double relative_error_floor = 0.01;

// Of a mean over pixels. The standard error is that of the difference between the estimate and the error that
// the film really has, which scatters as much as the estimate does; and in it is what a pixel may have missed
// of something as bright as the brightest pixel beside it: half a sample of it (Krichevsky & Trofimov 1981),
// in one of two such pixels.
struct NoiseEstimate {
  double mean = 0, standard_error = 0;
  std::uint32_t noisy_pixels = 0;  // whose two groups differ
  // The true error is below with a probability of 99 % at one look: of several looks and with errors as
  // skewed as those of pictures, nine times in ten. Few pixels say little of their own scatter: of n of them,
  // alike, true error and estimate are two independent χ² of n degrees of freedom, and the bound is at least
  // what their ratio exceeds in 3 % of cases.
  double upper() const;
};

// So many samples in all, at least, before an estimate is looked at: of few, the two groups of a pixel may
// agree by chance, and each further look is another chance to end too soon.
inline constexpr std::uint32_t least_samples_of_estimate = 1024;

// Of the mean of (Y − Y∞)²/(Y∞² + 0.01) over the pixels. The denominator is by the product of
// the pixel's two groups, or the greatest of the eight pixels around where that is less: a bright speck would
// divide by itself.
NoiseEstimate relative_squared_error(const Film& film);

// The same in just noticeable differences: of the mean of (ΔL*/2.3)², L* being CIELAB's lightness of Y, as it
// is shown without exposure, white at 1, brighter light no brighter. 2.3 units of ΔE*ab are just noticeable
// (Mahy, Van Eycken, Oosterlinck 1994).
NoiseEstimate displayed_squared_error(const Film& film);

}  // namespace vitrail
