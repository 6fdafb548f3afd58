// SPDX-License-Identifier: Apache-2.0
// Variances for the z-test, from what renderers write.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// What a film estimated of the variance of each pixel's mean luminance, each from so many groups of samples
// less one; one channel.
struct EstimatedVariance {
  const Image* variance = nullptr;
  int degrees_of_freedom = 0;
  double neighbours_of_variances = 1;  // film/neighbours.h
};

// Variances of the sum of what the parts are of, pooled: each pixel has the mean over the 7 × 7 pixels around
// it, or its own estimate where that is greater, so that a pixel noisier than those around it is not taken
// for wrong. Estimates of pixels that share no samples are independent. Where they share some, or where their
// variances differ, the mean has fewer degrees of freedom (Satterthwaite, "An approximate distribution of
// estimates of variance components", Biometrics Bulletin 2, 1946).
struct PooledVariance {
  std::vector<double> variance;         // one a pixel
  std::vector<int> degrees_of_freedom;  // ≥ 1
};
PooledVariance pooled(std::span<const EstimatedVariance> parts);

// Mitsuba's tests have the variance of one sample, E[X²] − E[X]² of X, Y and Z apart, written as if it were a
// colour in XYZ, that is as its R, G and B. Returns those of the mean of `samples`: three values a pixel. As
// in its tests, what is below 1e-4 for one sample becomes that.
std::vector<double> mitsuba_variance(const Image& rgb, double samples);

// Where the image has more variance in its luminance than the reference's samples had, all three channels
// get so many times more. `variance` is of X, Y, Z, `own` of the image's luminance. Returns for how many
// pixels.
std::size_t widen(std::vector<double>& variance, const std::vector<double>& own);

// The rounding of a half float of the reference's luminance, as many references are stored, is added to the
// variance of luminance.
void add_rounding(std::vector<double>& variance, const Image& reference);

}  // namespace vitrail
