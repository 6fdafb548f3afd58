// SPDX-License-Identifier: Apache-2.0
// How much of the difference between two images a viewer notices who flips between them: FLIP, of images for
// screens (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020) and of images of any range
// (Andersson, Nilsson, Shirley, Akenine-Möller 2021). 0: nothing; 1: as much as black and white, or green and
// blue, can.
#pragma once

#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// Of a screen 0.7 m wide with 3840 pixels, seen from 0.7 m: the papers' default.
inline constexpr double flip_pixels_per_degree = 67.0206432765823;

// In stops, chosen after the reference so that at the first its brightest pixel, at the last its median one,
// is shown at 85 % of white by the tone curve.
struct FlipExposures {
  double start_ev = 0, stop_ev = 0;
  int count = 2;
};
FlipExposures flip_exposures(const Image& reference);

// One value in [0, 1] a pixel; NaN in those that are not finite in either image. Both are linear sRGB of the
// same size, else Error is thrown. `ldr_flip` clamps to [0, 1]. `hdr_flip` takes the greatest error over the
// exposures, each shown by a curve in the manner of ACES.
std::vector<double> ldr_flip(const Image& image, const Image& reference,
                             double pixels_per_degree = flip_pixels_per_degree);
std::vector<double> hdr_flip(const Image& image, const Image& reference,
                             double pixels_per_degree = flip_pixels_per_degree);

}  // namespace vitrail
