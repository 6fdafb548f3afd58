// SPDX-License-Identifier: Apache-2.0
// A parameter is one value, or is looked up in a texture where it is used.
#pragma once

#include <variant>

#include "scene/records/id.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

struct Texture;

using FloatParameter = std::variant<float, Id<Texture>>;
using SpectrumParameter = std::variant<Spectrum, Id<Texture>>;

}  // namespace vitrail
