// SPDX-License-Identifier: Apache-2.0
// glTF's lights are in candela, lux and candela per square metre, the Scene's in watts. A picture shows cd/m²
// as numbers: 1 of the file is 1 of the picture.
#pragma once

#include "scene/daylight/photometry.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::gltf {

// The film multiplies radiance by it, so that the picture shows cd/m².
inline constexpr double shown_per_radiance = photometric(1);

// Returns light of D65's white times the colour (linear sRGB), of so many photometric units where the colour
// has luminance 1.
inline Spectrum emission(RGB color, double photometric_units) {
  const double f = photometric_units / shown_per_radiance;
  return emission_from_rgb({color.r * f, color.g * f, color.b * f});
}

}  // namespace vitrail::gltf
