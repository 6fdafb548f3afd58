// SPDX-License-Identifier: Apache-2.0
// This file turns the numbers of an image into the texels of a baked one.
#pragma once

#include <filesystem>

#include "bundle/reflectances/reflectance_fitter.h"
#include "bundle/texture_file.h"
#include "partitioner/appearance/image_rows.h"
#include "scene/spectra/rgb_method.h"

namespace vitrail {

// A TextureUse says what the values of a texture count as.
enum class TextureUse { reflectance, unbounded, illuminant, number, vector };

// Writes linear values of one channel or three (numbers: of one): all MIP levels or the finest. Images of
// greys become numbers, and unbounded ones that stay within [0,1] reflectances. Light whose numbers fit into
// 16 bits keeps them (bake_light_codes.h). Values that are not finite count as 0. The image is read twice,
// the first time only until its format is known, and never in memory as a whole. Throws MachineError.
WrittenTextureFile write_baked_image(const std::filesystem::path& file, const ImageRows& rows, TextureUse use,
                                     bool all_levels, const ReflectanceFitter& fitter,
                                     RgbMethod method = RgbMethod::jakob_hanika);

}  // namespace vitrail
