// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "scene/records/texture.h"

namespace vitrail::pbrt {

// Returns the mean luminance of all pixels of a light's image, by which pbrt-v4 divides a `power`; nothing
// where it cannot be read, or is black.
std::optional<double> mean_luminance(const ImageTexture& image);

}  // namespace vitrail::pbrt
