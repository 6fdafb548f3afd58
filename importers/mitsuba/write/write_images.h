// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "importers/mitsuba/write/write_context.h"
#include "scene/spectra/color.h"

namespace vitrail::mitsuba_writer {

// It is an image as Mitsuba's `bitmap` loads it: `raw` takes the numbers of the file as they are; otherwise
// integers are decoded from sRGB.
struct MitsubaImage {
  std::string filename;  // relative to the scene's
  bool raw = false;
};

// Returns the texture's own file where Mitsuba makes the same values of it; else a new one that holds the
// values, in colours times `tint`.
MitsubaImage image_for_mitsuba(Context& context, const ImageTexture& texture, bool is_float,
                               bool is_normal_map = false, RGB tint = {1, 1, 1});

// Returns a new file with the product of two; nothing where one of them cannot be read.
std::optional<MitsubaImage> image_for_mitsuba(Context& context, const ImagePair& pair, bool is_float);

// Returns the mean of the texture's values; grey ½ where the file cannot be read.
RGB mean_color(const ImageTexture& texture);

// Tells by the kind of file, as Mitsuba 3.9.1's bitmaps: no .gif, .tif or .webp, no JPEG of four channels, no
// Targa with a palette. Throws Error where the file cannot be opened.
bool is_read_by_mitsuba(const std::string& filename);

}  // namespace vitrail::mitsuba_writer
