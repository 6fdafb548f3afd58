// SPDX-License-Identifier: Apache-2.0
// Where two images differ, as images.
#pragma once

#include <optional>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// What is shown as the hottest: the 99th percentile of the errors that are numbers, or the greatest where
// that is 0.
double hottest(const std::vector<double>& error_map);

// Heat: black – red – yellow – white. Magma: that of Smith and van der Walt (2015), which FLIP's authors use.
// Sides: blue – white – red.
enum class Palette { heat, magma, sides };

// The errors as colours, linear from 0 to `hottest`; magenta (with magma green) where NaN.
Image heatmap(const std::vector<double>& error_map, int width, int height, double hottest,
              Palette palette = Palette::heat);

// The errors as they are, in all three channels.
Image error_image(const std::vector<double>& error_map, int width, int height);

// Image − reference, channel by channel.
Image signed_difference(const Image& image, const Image& reference);

// The luminance of a difference as colours: blue where the image is darker, red where it is brighter, white
// where they are equal; full at ±`hottest`.
Image signed_map(const Image& difference, double hottest);

// Below an image: a bar of the palette, with the numbers at its ends, 0 or for sides −`hottest` at the left.
// Images less than 64 pixels wide stay as they are: there is no room for numbers.
Image with_legend(const Image& image, double hottest, Palette palette);

}  // namespace vitrail
