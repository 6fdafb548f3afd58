// SPDX-License-Identifier: Apache-2.0
// These functions put a sky that the user gives (scene/daylight/given_sky.h) into a scene.
#pragma once

#include <string>

#include "scene/daylight/given_sky.h"
#include "scene/records/scene.h"

namespace vitrail {

// Returns the transform from +x east, +y north, +z up to the world with these axes. Throws UsageError where
// the axes are not perpendicular.
Transform sky_to_world(const std::string& up, const std::string& north);

// Returns the axis that is up in the camera's picture. Cameras look up and down more often than they are
// tilted, so axes level with the picture's rows come first; among them the one that points up most.
std::string up_of_camera(const Camera& camera);

// Puts the sky in place of all light from infinitely far. Diagnostics name the lights that it replaces, and
// the up axis where none was given. They compare its brightness with lamps that are brighter than usual.
void replace_sky(ImportedScene& imported, const GivenSky& sky);

}  // namespace vitrail
