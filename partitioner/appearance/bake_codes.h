// SPDX-License-Identifier: Apache-2.0
// These functions make of an image's bytes a baked image with the same codes: spectra
// are found when it is looked up.
#pragma once

#include <filesystem>
#include <optional>

#include "bundle/texture_file.h"
#include "images/byte_rows.h"
#include "partitioner/appearance/bake_image.h"
#include "scene/records/texture.h"

namespace vitrail {

// A CodedImage says how an image becomes codes: one or three of the channels that it has.
struct CodedImage {
  TexelFormat format = TexelFormat::color_code;
  std::size_t first_channel = 0;  // of the file: three from there on, or that one where it has fewer
  CodeValues values;              // they do not fall
};

// Returns nothing where the texture's values are no function of one byte each, or mean more than a
// reflectance, a number or light. An image of greys that does not shine counts as numbers, as
// write_baked_image has it. To know that, the image is read until a pixel is no grey. `texture` chooses no
// channel by alpha (without_choice). Throws as `rows` does.
std::optional<CodedImage> coded_image(const ImageTexture& texture, const ByteRows& rows, TextureUse use,
                                      RgbMethod method);

// Writes all MIP levels or the finest. The finest has the codes of the file. A level's exact mean lies
// between two values. The texel gets the code of one or the other, by a threshold that goes with its place.
// So means over some texels are right, and each is off by less than the distance of two values. Throws
// MachineError, and as `rows` does.
WrittenTextureFile write_coded_image(const std::filesystem::path& file, const ByteRows& rows,
                                     const CodedImage& coded, bool all_levels);

}  // namespace vitrail
