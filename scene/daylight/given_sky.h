// SPDX-License-Identifier: Apache-2.0
// This file reads a sky that the user gives in words, by place and time.
#pragma once

#include <string>

#include "scene/daylight/sun_position.h"
#include "scene/geometry/vec.h"
#include "scene/records/light.h"

namespace vitrail {

// Its words are "LATITUDE,LONGITUDE,TIME[,KEY=VALUE …]": degrees (north and east positive, or 33.9S and
// 70.7W) and a moment (local_time). Keys are turbidity=3 (a bare number too), ground, albedo, up and north.
// ground=0.2 is the share that the ground reflects below the horizon; without it all is black there.
// albedo=0.2 is what the clear sky's own brightness takes the ground for: without it that of `ground`, or
// 0.2. up and north take an axis: +x, -y, z. sun=0 and sky=0 leave out the one or the other.
//
// cie=1 … 15 is a sky of the CIE; overcast (1), uniform (5), intermediate (7) and clear (12) are names of
// some. diffuse=210W,direct=640W, or in lx, are irradiances or illuminances: of the sky on the ground, and of
// the sun across its direction. Without cie the sky is Perez's for these two. Both have the colour of D65, or
// of the CIE's daylight of cct=4000 … 25000 K.
//
// "FILE@MM-DDTHH:MM[,KEY=VALUE …]" takes place, zone, direct and diffuse from an hour of a weather file (.epw
// or .wea); the sun stands where it does in the middle of that hour. With lux=file the brightness is the
// file's own illuminances, not the watts by Perez's efficacies.
struct GivenSky {
  Site place;
  LocalTime time;
  SunPosition sun;
  std::string up, north;  // axes of the world; up "": the camera's, north "": −z where y is up, else +y
  SkyLight light;         // but for light_to_world
};
// Throws UsageError where the words are not such.
GivenSky parse_sky(const std::string& words);

// Returns the axis of this name: +x, -y, z …. Throws UsageError.
Vector3d axis_of(const std::string& name);

}  // namespace vitrail
