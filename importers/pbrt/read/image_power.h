// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "scene/records/texture.h"

namespace vitrail::pbrt {

// The mean luminance of all pixels of a light's image, which pbrt-v4 divides a `power` by; nothing where it
// cannot be read, or is black.
std::optional<double> mean_luminance(const ImageTexture& image);

}  // namespace vitrail::pbrt
