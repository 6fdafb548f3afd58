// SPDX-License-Identifier: Apache-2.0
// This file turns an image of light into a baked one that holds its numbers in 16 bits: spectra
// are found when it is looked up.
#pragma once

#include <filesystem>
#include <optional>

#include "bundle/texture_file.h"
#include "partitioner/appearance/image_rows.h"

namespace vitrail {

// Writes linear values of one channel or three as TexelFormat::light_code_16: all MIP levels or the finest.
// Returns nothing, and leaves no file, where a value of the image is in no code (bundle/light_code.h). The
// means of coarser levels get the nearest codes. Values that are not finite or negative count as 0. Throws
// MachineError, and as `rows` does.
std::optional<WrittenTextureFile> write_light_codes(const std::filesystem::path& file, const ImageRows& rows,
                                                    bool all_levels);

}  // namespace vitrail
