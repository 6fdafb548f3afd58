// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/records/image.h"

namespace vitrail {

struct CieLab {
  double l = 0, a = 0, b = 0;
};

// ΔE₀₀ (CIE 142-2001, as written down by Sharma, Wu, Dalal 2005): about 1 is just noticed side by side.
double ciede2000(CieLab first, CieLab second);

// Of each pixel of two pictures in linear sRGB of the same size, as a screen shows them where `white` is the
// luminance of its white: what is brighter is white. NaN where not finite.
std::vector<double> ciede2000_map(const Image& image, const Image& reference, double white);

// The luminance that 1 % of the pixels exceed; 1 where that is 0.
double bright_luminance(const Image& image);
// Of the finite pixels; 1 where that is not above 0.
double mean_luminance(const Image& image);

}  // namespace vitrail
