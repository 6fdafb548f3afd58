// SPDX-License-Identifier: Apache-2.0
// Solar heat is what sun and sky bring through a pane as heat, hour by hour.
#pragma once

#include <array>
#include <vector>

#include "cli/year/year_figures.h"
#include "glazing/system.h"
#include "scene/daylight/sky_patches.h"

namespace vitrail {

// This is the solar heat gain coefficient of a glazing (SHGC; NFRC's summer, ISO 15099).
struct SolarGain {
  std::array<double, 10> each_10_deg{};  // at 0°, 10° … 90°
  double hemisphere = 0;
  // Returns the coefficient, linear between those angles; behind the pane it is that of the hemisphere.
  double at(double cosine) const;
};
// Returns the coefficients of the glazing in its present state. Throws Error where its
// file does not say what heat needs.
SolarGain solar_gain(GlazingSystem system);

// Solar heat is in W/m² of glass.
struct SolarHeat {
  std::vector<float> on_the_pane, let_in;  // an hour each
  YearEstimate year_kwh;                   // of what is let in, kWh/m²; for hours that follow each other
};
// `sensor` lies before the pane's outside and faces as it does: `normal`, in the sky's frame. Light from the
// sky and the sun counts by its angle; light from the ground or from surfaces counts as from the whole
// hemisphere. An hour's W over lm are those of its weather, apart for sky and sun.
SolarHeat solar_heat(const SkyYear& year, const SkyPatches& patches,
                     const std::vector<StateCoefficients>& states, const std::vector<SolarGain>& gains,
                     const std::vector<std::size_t>& of_hours, std::size_t sensor, Vector3d normal);

// It is the part of the sun's and the sky's irradiance that is ultraviolet: 280 to 400 nm
// of the global spectrum of ASTM G173.
inline constexpr double ultraviolet_share = 0.046;

// Returns the hours' states of photochromic glass under that part of the light on the pane: the nearest, at
// each hour's end, of the traced `states` in [0, 1]. The year begins with clear glass.
std::vector<std::size_t> photochromic_states(const PhotochromicLight& light,
                                             const std::vector<double>& states,
                                             const std::vector<float>& on_the_pane_w_m2);

}  // namespace vitrail
