// SPDX-License-Identifier: Apache-2.0
// These settings are what a file asks of a renderer.
#pragma once

#include <cstdint>
#include <optional>

#include "scene/spectra/rgb_method.h"

namespace vitrail {

inline constexpr int unlimited_depth = 1 << 20;

// It sets photon mapping. Empty optionals are chosen by the extent of the scene and the size of the picture.
struct PhotonSettings {
  std::optional<std::uint64_t> photons;  // an iteration, which is a sample of every pixel
  std::optional<double> first_radius;    // in which they are gathered, scene units
  std::optional<double> alpha;           // how fast the radius shrinks, in (0, 1); ⅔
  bool operator==(const PhotonSettings&) const = default;
};

// It holds what the scene file asks for; the command line overrides it. Depth counts scattering events as
// pbrt does: 0 shows emitters only, 1 adds direct light.
struct RenderSettings {
  int samples_per_pixel = 16;
  int max_depth = 5;
  bool direct_only = false;  // direct light at the first diffuse hit; specular chains go on
  // It says whether going straight through a MaskMaterial or a thin sheet is a scattering event, too.
  // Mitsuba's volumetric integrators do not count it. (Passing where a shape's opacity says that nothing is
  // there is never an event.)
  bool straight_counts = true;
  bool hides_emitters = false;  // lamps and surroundings, where the camera sees them directly
  RgbMethod rgb = RgbMethod::jakob_hanika;
  std::optional<PhotonSettings> photons;  // empty: no photon mapping
  bool operator==(const RenderSettings&) const = default;
};

}  // namespace vitrail
