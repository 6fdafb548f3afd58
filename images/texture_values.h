// SPDX-License-Identifier: Apache-2.0
// These functions turn the numbers of a file into the values that a texture means by them.
#pragma once

#include "images/image_files.h"
#include "scene/records/light.h"

namespace vitrail {

// It says how the values are used. Vectors are the file's own numbers unless the texture says otherwise.
enum class ImageUse { color, light, number, vector };

// Returns the values decoded, in linear sRGB, scaled and inverted as the texture says. They have three
// channels or one, numbers one, and no alpha. `stored` may be some rows of the file where the texture's
// number is no choice.
Image texture_values(const ImageTexture& texture, StoredImage stored, ImageUse use);

// Returns the texture with the number that a choice by alpha comes to in its file. Throws as read_stored_rows
// does.
ImageTexture without_choice(ImageTexture texture);

// Returns whether the file states primaries other than sRGB's that the texture's renderer does not look at.
bool ignores_primaries(const ImageTexture& texture, const ImageLayout& layout);

// Returns whether two textures make the same values of their files for that use, to 1e-6 of each. It reads no
// file where their fields tell. Throws as read_stored_image does.
bool have_same_values(const ImageTexture& a, const ImageTexture& b, ImageUse use);

// Returns one channel, taken from each pixel of linear values.
Image numbers_of(const Image& image, ImageNumber number);

// Returns the image of a light, for ImageUse::light and ::number.
ImageTexture image_of(const EnvironmentLight& light);
ImageTexture image_of(const GoniometricLight& light);

}  // namespace vitrail
