// SPDX-License-Identifier: Apache-2.0
// Variances for the z-test, from what renderers write.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/image.h"

namespace vitrail {

// The variance of the mean luminance of each pixel: a plane of one channel.
std::vector<double> luminance_variance(const Image& variance);

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
