// SPDX-License-Identifier: Apache-2.0
// SSIM is the structural similarity (Wang, Bovik, Sheikh & Simoncelli 2004, eq. 13) of luminance as a screen
// shows it, clamped to [0,1] and encoded as sRGB. A Gaussian of σ = 1.5 over those of 11 × 11 pixels that are
// in the image weights means, variances and the covariance. C₁ = 0.01², C₂ = 0.03².
#pragma once

#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// Returns the similarity in each pixel, −1 to 1, where 1 is no difference. It is NaN where a pixel in the
// window is not finite. Throws Error if the sizes differ.
std::vector<double> ssim_map(const Image& image, const Image& reference);

}  // namespace vitrail
