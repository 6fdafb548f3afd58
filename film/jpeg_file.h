// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "film/develop.h"

namespace vitrail {

// Writes the colours as write_picture (image_io.h) has them, of 8 bits, as a JPEG of quality 95 whose colours
// have the resolution of its brightness. EXIF says the date, that it is sRGB, who made it and who denoised
// it. The file appears whole or not at all. Throws MachineError.
void write_jpeg(const std::filesystem::path& file, const Picture& picture);

}  // namespace vitrail
