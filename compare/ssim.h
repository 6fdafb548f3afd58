// SPDX-License-Identifier: Apache-2.0
// Structural similarity (Wang, Bovik, Sheikh & Simoncelli 2004, eq. 13) of luminance as a screen shows it:
// clamped to [0,1] and encoded as sRGB. Means, variances and the covariance are weighted by a Gaussian of
// σ = 1.5 over 11 × 11 pixels, at borders by those of them that are there; C₁ = 0.01², C₂ = 0.03².
#pragma once

#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// In each pixel, −1 to 1, where 1 is no difference; NaN where a pixel that counts is not finite. Throws Error
// if the sizes differ.
std::vector<double> ssim_map(const Image& image, const Image& reference);

}  // namespace vitrail
