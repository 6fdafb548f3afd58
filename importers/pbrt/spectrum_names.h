// SPDX-License-Identifier: Apache-2.0
// The spectra that pbrt knows by name, beyond those of scene/named_spectra.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scene/color.h"
#include "scene/spectrum.h"

namespace vitrail::pbrt {

struct NamedSpectrum {
  Spectrum spectrum;
  std::string approximation;  // what stands for it, or "" where it is exact
};

// Of named_spectrum, or an illuminant that a blackbody stands for. Empty when unknown.
std::optional<NamedSpectrum> find_named_spectrum(const std::string& name);

// Linear sRGB reflectance at normal incidence of pbrt's metals, by the name of either of their spectra:
// "metal-Cu-eta".
std::optional<RGB> metal_reflectance(std::string_view name);

}  // namespace vitrail::pbrt
