// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tracer/lights/light_image.h"

namespace vitrail {

// Opens an image of a bundle. Throws Error with the file's name where it is damaged.
std::shared_ptr<const LightImage> open_light_image(const std::filesystem::path& file,
                                                   std::shared_ptr<TileCache> tiles);

}  // namespace vitrail
