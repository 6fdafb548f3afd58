// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "scene/color.h"
#include "scene/scene.h"

namespace vitrail {

// The mean of what a texture has over all of its image, or its cells, and by how much in the root mean square
// it is off that, in the colour that is most.
struct TextureMean {
  RGB color;
  double deviation = 0;
};

// Of images, Ptex, checkerboards, and these times a constant; nothing for others. Throws Error for images
// that cannot be read.
std::optional<TextureMean> mean_of(const Scene& scene, const SpectrumParameter& parameter);

}  // namespace vitrail
