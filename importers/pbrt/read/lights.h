// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "importers/pbrt/read/textures.h"
#include "scene/records/scene.h"

namespace vitrail::pbrt {

// An image of the sky of a given "illuminance" E shows twice that in pbrt-v4: its lights.cpp weighs each
// pixel above the horizon by 2π over the number of all pixels, and the pixels of an equal-area map cover 4π
// over it.
inline constexpr float sky_per_illuminance = 2;

// Makes the light of a LightSource directive; nothing where its kind is unknown and it is dropped.
std::optional<Light> make_light(const std::string& kind, ParameterSet& parameters, const Transform& ctm,
                                const Scope& scope);

// It is an AreaLightSource directive. If `power` is above 0, radiance is 1 / (π · area), times 1/2 if
// two-sided, for the unit of power; the area is that of the shape which has the light.
struct AreaEmission {
  AreaLight light;
  double power = 0;
  Place place;
};

AreaEmission make_area_emission(const std::string& kind, ParameterSet& parameters, const Scope& scope);

}  // namespace vitrail::pbrt
