// SPDX-License-Identifier: Apache-2.0
// False colours show luminance, with a scale beside the picture that says which colour is how much.
#pragma once

#include <string>

#include "scene/records/image.h"

namespace vitrail {

struct FalseColor {
  double most = 0;  // cd/m² at the scale's upper end; 0: a round number that 99.9 % of pixels are below
  bool logarithmic = false;  // over three decades
};

// Takes a picture in linear sRGB whose Y is W·m⁻²·sr⁻¹·nm⁻¹ over ∫ȳ, as films give it. The result is linear
// sRGB, too, wider by the scale, as high or as high as that needs. Light above the scale has its last colour.
// The colours are viridis (Smith and van der Walt 2015): of even steps for the eye, and in grey.
Image false_colored(const Image& rgb, FalseColor manner);

// Returns the least 1, 2 or 5 times a power of ten that is not below x > 0.
double round_above(double x);

}  // namespace vitrail
