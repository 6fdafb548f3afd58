// SPDX-License-Identifier: Apache-2.0
// These functions of ImageCodec have files of their own. They are for the module alone.
#pragma once

#include <OpenImageIO/imageio.h>

#include "images/image_codec.h"
#include "images/radiance_header.h"

namespace vitrail {

// Returns the header of a Radiance file; for another file, a header that changes nothing.
RadianceHeader radiance_header_of(const OIIO::ImageInput& in, const std::string& file);

std::string encode_picture(const std::string& file, const PictureFile& picture, const void* pixels,
                           std::vector<std::byte>& bytes);
std::string decode_picture(const std::string& file, PictureFile& picture, std::vector<float>& values);
std::string map_tones(Image& rgb, const std::array<double, 9>& to_xyz);

}  // namespace vitrail
