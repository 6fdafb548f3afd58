// SPDX-License-Identifier: Apache-2.0
// These functions make the variances of the z-test from what renderers write.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// EstimatedVariance is a film's estimate of the variance of each pixel's mean luminance, one channel. Each
// estimate is from degrees_of_freedom + 1 groups of samples.
struct EstimatedVariance {
  const Image* variance = nullptr;
  int degrees_of_freedom = 0;
  double neighbours_of_variances = 1;  // film/neighbours.h
};

// PooledVariance holds variances of the sum of the parts' pictures. Each pixel has the mean over the 7 × 7
// pixels around it, or its own estimate where that is greater. So a pixel noisier than its neighbours is not
// taken for wrong. Estimates of pixels that share no samples are independent. Where they share some, or where
// their variances differ, the mean has fewer degrees of freedom (Satterthwaite, "An approximate distribution
// of estimates of variance components", Biometrics Bulletin 2, 1946).
struct PooledVariance {
  std::vector<double> variance;         // one a pixel
  std::vector<int> degrees_of_freedom;  // ≥ 1
};
PooledVariance pooled(std::span<const EstimatedVariance> parts);

// Returns the variances of the mean of `samples` samples, three values a pixel. Mitsuba's tests store the
// variance of one sample, E[X²] − E[X]² of X, Y and Z, as the R, G and B of a colour of such an XYZ. A
// variance of one sample below 1e-4 becomes 1e-4, as in its tests.
std::vector<double> mitsuba_variance(const Image& rgb, double samples);

// Multiplies the variance of X, Y and Z by `own` over the variance of Y where that is greater than 1.
// `variance` is that of the reference's samples, three values a pixel; `own` is that of the image's
// luminance. Returns the number of such pixels.
std::size_t widen(std::vector<double>& variance, const std::vector<double>& own);

// Adds to the variance of luminance the square of the reference's rounding to a half float:
// many references are stored so.
void add_rounding(std::vector<double>& variance, const Image& reference);

}  // namespace vitrail
