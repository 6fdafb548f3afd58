// SPDX-License-Identifier: Apache-2.0
// From the numbers of a file to the values that a texture means by them.
#pragma once

#include "images/image_files.h"
#include "scene/records/light.h"

namespace vitrail {

// What the values are used as. Vectors are the file's own numbers unless the texture says otherwise.
enum class ImageUse { color, light, number, vector };

// Decoded, in linear sRGB, scaled and inverted as the texture says. Of three channels or one, numbers of one;
// without alpha. `stored` may be some rows of the file where the texture's number is no choice.
Image texture_values(const ImageTexture& texture, StoredImage stored, ImageUse use);

// The texture with the number that a choice by alpha comes to in its file. Throws as read_stored_rows does.
ImageTexture without_choice(ImageTexture texture);

// Whether the file states primaries other than sRGB's that the texture's renderer does not look at.
bool ignores_primaries(const ImageTexture& texture, const ImageLayout& layout);

// Whether two textures make the same values of their files for that use, to 1e-6 of each. Reads no file where
// their fields tell. Throws as read_stored_image does.
bool have_same_values(const ImageTexture& a, const ImageTexture& b, ImageUse use);

// One channel, taken from each pixel of linear values.
Image numbers_of(const Image& image, ImageNumber number);

// The image of a light, for ImageUse::light and ::number.
ImageTexture image_of(const EnvironmentLight& light);
ImageTexture image_of(const GoniometricLight& light);

}  // namespace vitrail
