// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "scene/records/scene.h"
#include "scene/spectra/color.h"

namespace vitrail {

// It is a texture's mean over all of its image, or its cells. `deviation` is the root mean square difference
// from it, in the colour that has most.
struct TextureMean {
  RGB color;
  double deviation = 0;
};

// KnownMeans are by texture: each is looked at once, however often it is shared.
using KnownMeans = std::map<std::uint32_t, std::optional<TextureMean>>;

// Returns the mean of colours, images, Ptex, checkerboards, and these times a constant; nothing for others.
// Throws Error for images that cannot be read.
std::optional<TextureMean> mean_of(const Scene& scene, KnownMeans& known, const SpectrumParameter& parameter);

}  // namespace vitrail
