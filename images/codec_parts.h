// SPDX-License-Identifier: Apache-2.0
// The functions of ImageCodec that have files of their own. For the module alone.
#pragma once

#include "images/image_codec.h"

namespace vitrail {

std::string encode_picture(const std::string& file, const PictureFile& picture, const void* pixels,
                           std::vector<std::byte>& bytes);
std::string decode_picture(const std::string& file, PictureFile& picture, std::vector<float>& values);
std::string map_tones(Image& rgb, const std::array<double, 9>& to_xyz);

}  // namespace vitrail
