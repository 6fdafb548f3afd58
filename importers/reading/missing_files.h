// SPDX-License-Identifier: Apache-2.0
// What stands for files that a scene names and nobody has, where the user asks for it: a scene with one lost
// texture can be seen.
#pragma once

#include "scene/records/scene.h"

namespace vitrail {

// Said with an error about such a file.
inline constexpr const char* how_to_replace_missing = "; --missing=replace goes on without it";

// Throws Error, with the place of the first and the names and places of the others in its message, where an
// image or table of the scene is not there or no file: those that replace_missing_images replaces.
void require_images(const Scene& scene);

// Textures whose image is not there become 0.5, normal maps nothing, materials by a table diffuse, lights
// around and goniometric ones the same in all directions, media by a grid nothing; a diagnostic each.
void replace_missing_images(ImportedScene& imported);

}  // namespace vitrail
