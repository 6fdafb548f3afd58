// SPDX-License-Identifier: Apache-2.0
// This file leaves pixels out of a comparison. The pixels of an image that remain form
// one row, which every metric takes.
#pragma once

#include <span>
#include <vector>

#include "scene/records/film_settings.h"
#include "scene/records/image.h"

namespace vitrail {

// True means that the pixel is left out.
using Mask = std::vector<bool>;

// Leaves out the pixels of the rectangles, and those that are black in `kept`, unless it is 0 × 0. Throws
// Error if nothing remains, a rectangle leaves the image or the sizes differ.
Mask make_mask(int width, int height, std::span<const PixelRect> ignored, const Image& kept);

Image without(const Image& image, const Mask& mask);
// `values` holds the same number of values for each pixel of the mask.
std::vector<double> without(const std::vector<double>& values, const Mask& mask);
std::vector<int> without(const std::vector<int>& values, const Mask& mask);
// Spreads one value a pixel that remained to one a pixel of the image, 0 in pixels that were left out.
std::vector<double> spread(const std::vector<double>& values, const Mask& mask);

}  // namespace vitrail
