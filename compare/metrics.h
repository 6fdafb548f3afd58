// SPDX-License-Identifier: Apache-2.0
// These metrics tell how far an image is from a reference. Images are linear sRGB, 3 channels, of one size.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// They return errors of one channel, where a is the image and b the reference.
double squared_error(double a, double b);   // (a − b)²
double absolute_error(double a, double b);  // |a − b|
// Returns (a − b)²/(b² + ε), where ε = 0.01 avoids division by black (after Rousselle, Knaus, Zwicker 2011).
double relative_squared_error(double a, double b);
// Returns 2|a − b|/(|a| + |b|), 0 where both are 0 (Makridakis 1993).
double symmetric_relative_error(double a, double b);

// Returns each pixel's mean of a channel error over the channels, NaN in pixels that are not finite in either
// image. Throws Error if the sizes differ.
std::vector<double> error_map(const Image& image, const Image& reference,
                              const std::function<double(double, double)>& channel_error);

// Returns 1 in pixels with any bit different, else 0: NaN equals itself, −0 differs from 0.
std::vector<double> difference_map(const Image& image, const Image& reference);

// Returns the mean of the values that are not NaN; NaN if all are.
double mean_of_valid(std::span<const double> values);

// Returns 10 log₁₀(1/MSE) dB, for a peak of 1; ∞ for equal images.
double psnr_of_mse(double mse);

// Returns the number of pixels with a channel that is not finite.
std::size_t count_nonfinite(const Image& image);

// MeanRatios are means of the image over means of the reference, over the pixels that are finite in both.
// Without bias they are 1; they are NaN where the reference is black.
struct MeanRatios {
  double x = 0, luminance = 0, z = 0, red = 0, green = 0, blue = 0;
};
// Returns the ratios of two images of one size.
MeanRatios mean_ratios(const Image& image, const Image& reference);

// Returns the standard error of the ratio of mean luminances. It holds if pixels' differences are
// independent but for what splatting makes alike (Neighbours::of_mean): noise is, a wrong shadow is not. It
// is NaN where the reference is black.
double luminance_ratio_error(const Image& image, const Image& reference, double neighbours_of_mean = 1);

// Throws Error unless they are of one size.
void require_same_size(const Image& image, const Image& reference);

}  // namespace vitrail
