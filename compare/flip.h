// SPDX-License-Identifier: Apache-2.0
// FLIP estimates how much of the difference between two images a viewer notices who flips between them. 0 is
// nothing; 1 is as much as black and white, or green and blue, can differ. It is published for images on
// screens (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020) and for images of any range
// (Andersson, Nilsson, Shirley, Akenine-Möller 2021).
#pragma once

#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// It is that of a screen 0.7 m wide with 3840 pixels, seen from 0.7 m: the papers' default.
inline constexpr double flip_pixels_per_degree = 67.0206432765823;

// Exposures are in stops and chosen by the reference. The tone curve shows its brightest pixel at 85 % of
// white at the first exposure, and its median pixel at the last.
struct FlipExposures {
  double start_ev = 0, stop_ev = 0;
  int count = 2;
};
FlipExposures flip_exposures(const Image& reference);

// They return one value in [0, 1] a pixel, NaN in pixels that are not finite in either image. Both images are
// linear sRGB of the same size, else Error is thrown. `ldr_flip` clamps them to [0, 1]. `hdr_flip` takes the
// greatest error over the exposures, each shown by a curve in the manner of ACES.
std::vector<double> ldr_flip(const Image& image, const Image& reference,
                             double pixels_per_degree = flip_pixels_per_degree);
std::vector<double> hdr_flip(const Image& image, const Image& reference,
                             double pixels_per_degree = flip_pixels_per_degree);

}  // namespace vitrail
