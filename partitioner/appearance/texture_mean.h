// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "scene/records/scene.h"
#include "scene/spectra/color.h"

namespace vitrail {

// The mean of what a texture has over all of its image, or its cells, and by how much in the root mean square
// it is off that, in the colour that is most.
struct TextureMean {
  RGB color;
  double deviation = 0;
};

// By texture: each is looked at once, however often it is shared.
using KnownMeans = std::map<std::uint32_t, std::optional<TextureMean>>;

// Of images, Ptex, checkerboards, and these times a constant; nothing for others. Throws Error for images
// that cannot be read.
std::optional<TextureMean> mean_of(const Scene& scene, KnownMeans& known, const SpectrumParameter& parameter);

}  // namespace vitrail
