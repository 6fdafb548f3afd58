// SPDX-License-Identifier: Apache-2.0
// This file reads pictures of OpenEXR's usual kind by its own library, which loads in a
// hundredth of OpenImageIO's time.
#pragma once

#include <filesystem>
#include <vector>

#include "images/image_codec.h"

namespace vitrail {

// Reads a file of one part whose channels are floats or halves of every pixel, R, G and B among them. It
// fills `picture` and `values` as ImageCodec::decode_picture does. Returns false for other files. Throws
// Error where such a file is damaged.
bool read_plain_exr(const std::filesystem::path& file, PictureFile& picture, std::vector<float>& values);

}  // namespace vitrail
