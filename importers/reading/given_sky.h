// SPDX-License-Identifier: Apache-2.0
// A sky that the user gives, by place and time.
#pragma once

#include <string>

#include "scene/daylight/sun_position.h"
#include "scene/records/scene.h"

namespace vitrail {

// "LATITUDE,LONGITUDE,TIME[,KEY=VALUE …]": degrees (north and east positive, or 33.9S and 70.7W), a moment
// (local_time), then any of turbidity=3 (a bare number too), albedo=0.2 (of the ground), up=y|z|…, north=…,
// with an axis as +x, -y, z; sun=0 and sky=0 leave out the one or the other.
struct GivenSky {
  Place place;
  LocalTime time;
  SunPosition sun;
  std::string up, north;  // axes of the world; up "": the camera's, north "": −z where y is up, else +y
  SkyLight light;         // but for light_to_world
};
// Throws UsageError.
GivenSky parse_sky(const std::string& words);

// +x east, +y north, +z up, to the world with these axes. Throws UsageError where they are not across.
Transform sky_to_world(const std::string& up, const std::string& north);

// The axis that is up in the camera's picture: of those that are level with the picture's rows the one that
// points up most, since cameras look up and down more than they are tilted.
std::string up_of_camera(const Camera& camera);

// Puts it in place of all light from infinitely far, and says what is replaced, what is up where that was not
// given, and how bright the scene's lamps are beside it where that is more than lamps mostly are.
void replace_sky(ImportedScene& imported, const GivenSky& sky);

}  // namespace vitrail
