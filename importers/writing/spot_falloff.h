// SPDX-License-Identifier: Apache-2.0
// Spot lights are written to formats whose light falls off towards the edge in another way.
#pragma once

#include "scene/records/light.h"

namespace vitrail {

// Returns the light's share of its greatest intensity at an angle from the axis.
double spot_falloff(const SpotLight& light, double theta_rad);

// It is the light with the other falloff: of the same flux, and as wide between full and no light as their
// deviation says. `difference` is the greatest between the two intensities, relative to the greatest
// intensity.
struct MatchedSpot {
  double beam_deg, cutoff_deg, difference;
};
MatchedSpot matched_spot(const SpotLight& light, SpotLight::Falloff to);

}  // namespace vitrail
