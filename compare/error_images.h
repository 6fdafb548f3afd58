// SPDX-License-Identifier: Apache-2.0
// These functions show where two images differ, as images.
#pragma once

#include <optional>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// Returns the error that is shown as the hottest: the 99th percentile of the errors that are not NaN. It is
// the greatest error where that percentile is 0.
double hottest(const std::vector<double>& error_map);

// Heat runs black – red – yellow – white, and sides blue – white – red. Magma is the map of Smith and van der
// Walt (2015), which FLIP's authors use.
enum class Palette { heat, magma, sides };

// Returns the errors as colours, linear from 0 to `hottest`. NaN is magenta, with magma green.
Image heatmap(const std::vector<double>& error_map, int width, int height, double hottest,
              Palette palette = Palette::heat);

// Returns the errors as they are, in all three channels.
Image error_image(const std::vector<double>& error_map, int width, int height);

// Returns image − reference, channel by channel.
Image signed_difference(const Image& image, const Image& reference);

// Shows the luminance of a difference: blue where the image is darker, red where it is brighter, white where
// they are equal. The colour is full at ±`hottest`.
Image signed_map(const Image& difference, double hottest);

// Adds a bar of the palette below an image, with the numbers at its ends: 0, or for sides −`hottest`, at the
// left. Images less than 64 pixels wide stay as they are: there is no room for numbers.
Image with_legend(const Image& image, double hottest, Palette palette);

}  // namespace vitrail
