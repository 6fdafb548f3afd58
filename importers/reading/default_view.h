// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// It is the message about the sky that add_default_view adds.
inline constexpr const char* sky_is_added =
    "there is no light: a white sky and a sun are added; --sky LATITUDE,LONGITUDE,TIME gives real ones";
// It is the message where there are lamps without power, such as a black image that shines.
inline constexpr const char* sky_is_added_to_lamps =
    "its lamps light nearly nothing, less than 1/200 of white: a white sky and a sun are added; --sky "
    "LATITUDE,LONGITUDE,TIME gives real ones";

// Gives geometry a camera that sees all of it, from the front and a little from above; +y is up. It adds the
// default light as add_default_light does. Diagnostics report camera and light.
void add_default_view(ImportedScene& imported, const std::filesystem::path& file);

// Adds light where the lamps make the scene no brighter than 1/200 of white (lamp_power.h): a sky, a sun, and
// a weak lamp from the camera. A white surface that faces sun and camera shows 1, and a surface that faces
// the camera is brighter than the sky behind it. It is for formats whose files often leave light to the
// program that shows them. Diagnostics report it.
void add_default_light(ImportedScene& imported, const std::filesystem::path& file);

}  // namespace vitrail
