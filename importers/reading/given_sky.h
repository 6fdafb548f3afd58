// SPDX-License-Identifier: Apache-2.0
// A sky that the user gives, by place and time.
#pragma once

#include <string>

#include "scene/daylight/sun_position.h"
#include "scene/records/scene.h"

namespace vitrail {

// "LATITUDE,LONGITUDE,TIME[,KEY=VALUE …]": degrees (north and east positive, or 33.9S and 70.7W) and a moment
// (local_time). Keys are turbidity=3 (a bare number too), albedo=0.2 (of the ground), up and north. The last
// two take an axis: +x, -y, z. sun=0 and sky=0 leave out the one or the other.
//
// cie=1 … 15 is a sky of the CIE; overcast (1), uniform (5), intermediate (7) and clear (12) are names of
// some. diffuse=210W,direct=640W, or in lx, are irradiances or illuminances: of the sky on the ground, and of
// the sun across its direction. Without cie the sky is Perez's for these two.
//
// "FILE@MM-DDTHH:MM[,KEY=VALUE …]" takes place, zone, direct and diffuse from an hour of a weather file (.epw
// or .wea); the sun stands where it does in the middle of that hour.
struct GivenSky {
  Place place;
  LocalTime time;
  SunPosition sun;
  std::string up, north;  // axes of the world; up "": the camera's, north "": −z where y is up, else +y
  bool is_clear = true;   // by its turbidity, not by a distribution
  SkyLight light;         // but for light_to_world
};
// Throws UsageError.
GivenSky parse_sky(const std::string& words);

// +x east, +y north, +z up, to the world with these axes. Throws UsageError where they are not across.
Transform sky_to_world(const std::string& up, const std::string& north);

// The axis that is up in the camera's picture. Cameras look up and down more often than they are tilted, so
// axes level with the picture's rows come first; among them the one that points up most.
std::string up_of_camera(const Camera& camera);

// Puts it in place of all light from infinitely far. Diagnostics name the lights that it replaces, and the up
// axis where none was given. They compare its brightness with lamps that are brighter than usual.
void replace_sky(ImportedScene& imported, const GivenSky& sky);

}  // namespace vitrail
