// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/records/light.h"

namespace vitrail {

// It is what a goniometric light sends into its directions, as multiples of its `intensity`.
struct MeanIntensity {
  double mean = 1;      // over all directions: a point light of this intensity has the same flux
  double greatest = 1;  // in one direction
};

// Throws Error where the light's image cannot be read.
MeanIntensity mean_intensity(const GoniometricLight& light);

// It is the light as one that is equal in all directions.
struct EvenLight {
  Spectrum intensity;  // of the same flux; the light's own where its image cannot be read
  std::string note;    // what that changes
};
EvenLight even_light(const GoniometricLight& light);

}  // namespace vitrail
