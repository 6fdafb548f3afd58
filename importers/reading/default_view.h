// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// What is said of the sky that add_default_view adds.
inline constexpr const char* sky_is_added =
    "there is no light: a white sky and a sun are added; --sky LATITUDE,LONGITUDE,TIME gives real ones";

// Gives geometry a camera that sees all of it, from the front and a little from above; +y is up. Where
// nothing shines it adds the default light. Diagnostics report both.
void add_default_view(ImportedScene& imported, const std::filesystem::path& file);

// Where nothing shines: a white sky and a sun, under which a white surface that faces the sun has radiance 1.
// For formats whose files often leave light to the program that shows them. Diagnostics report it.
void add_default_light(ImportedScene& imported, const std::filesystem::path& file);

}  // namespace vitrail
