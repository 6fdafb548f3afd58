// SPDX-License-Identifier: Apache-2.0
// Pictures as OpenEXR files, without the library: what is rendered is written where there is no OpenImageIO.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "images/image_codec.h"

namespace vitrail {

// A file of scan lines, compressed by ZIP in blocks of 16 (OpenEXR, "File Layout"). `pixels`: 32 bits each,
// interleaved as the picture's channels, the top left one first. Channels are sorted by name, as the format
// asks for. "DateTime" and "Software" are called capDate and software there. Throws MachineError.
std::vector<std::byte> exr_bytes(const PictureFile& picture, std::span<const std::uint32_t> pixels);

}  // namespace vitrail
