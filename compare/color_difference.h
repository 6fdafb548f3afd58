// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/records/image.h"

namespace vitrail {

struct CieLab {
  double l = 0, a = 0, b = 0;
};

// Returns ΔE₀₀ (CIE 142-2001; Sharma, Wu, Dalal 2005): about 1 is just noticed side by side.
double ciede2000(CieLab first, CieLab second);

// Returns ΔE₀₀ of each pixel of two pictures of one size in linear sRGB. Luminance `white` is a screen's
// white, and brighter light is shown as white. NaN marks pixels that are not finite.
std::vector<double> ciede2000_map(const Image& image, const Image& reference, double white);

// Returns the luminance that 1 % of the pixels exceed; 1 where that is 0.
double bright_luminance(const Image& image);
// Returns the mean luminance of the finite pixels; 1 where it is not above 0.
double mean_luminance(const Image& image);

}  // namespace vitrail
