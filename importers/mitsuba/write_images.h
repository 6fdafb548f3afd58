// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write_context.h"
#include "scene/color.h"

namespace vitrail::mitsuba_writer {

// An image as Mitsuba's `bitmap` loads it: `raw` takes the numbers of the file as they are; otherwise
// integers are decoded from sRGB.
struct MitsubaImage {
  std::string filename;  // relative to the scene's
  bool raw = false;
};

// Of a texture that is an image: its own file where Mitsuba makes the same values of it; else a new one that
// holds the values.
MitsubaImage image_for_mitsuba(Context& context, Id<Texture> id);

// The mean of the texture's values; grey ½ where the file cannot be read.
RGB mean_color(const ImageTexture& texture);

}  // namespace vitrail::mitsuba_writer
