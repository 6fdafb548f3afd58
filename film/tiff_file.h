// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "film/develop.h"

namespace vitrail {

// Writes the colours as write_picture (image_io.h) has them, of 8 or 16 `bits`, as a TIFF whose strips are
// deflated. It is a BigTIFF where the pixels have more than `most_bytes`, as the places in others have 32
// bits. Its tags say the date, who made it, who denoised it, and a part's place in the whole picture. Beside
// the picture a strip of 32 rows is in memory. The file appears whole or not at all. Throws MachineError.
void write_tiff(const std::filesystem::path& file, const Picture& picture, int bits = 16,
                std::uint64_t most_bytes = 4'000'000'000);

}  // namespace vitrail
