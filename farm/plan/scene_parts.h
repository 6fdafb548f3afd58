// SPDX-License-Identifier: Apache-2.0
// These functions describe a scene in words, part by part, so that a film of another scene can say in what
// that differs.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "bundle/manifest.h"

namespace vitrail {

// Returns {"camera": "perspective at (0, 0, 5) along (0, 0, -1)", "materials": "12, checksum 3fa9…", …}, the
// same however the scene is cut into domains. `bundle` is where the manifest was read.
nlohmann::ordered_json scene_parts(const Manifest& manifest, const std::filesystem::path& bundle);

// Returns the parts in which two scenes differ, by the FilmProgress::about of a film of each: "camera: A,
// this command has B; …". Shapes are named where nothing else differs. `about` may be of a program that wrote
// no parts.
std::string differences_of_scenes(const std::string& about, const std::string& asked_for);

}  // namespace vitrail
