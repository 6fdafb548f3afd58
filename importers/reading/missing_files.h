// SPDX-License-Identifier: Apache-2.0
// A scene may name files that nobody has. These functions refuse it, or replace them where the user asks for
// it: then a scene with one lost texture can be seen.
#pragma once

#include "scene/records/scene.h"

namespace vitrail {

// It is the end of the message about such a file.
inline constexpr const char* how_to_replace_missing = "; --missing=replace continues without it";

// Throws Error where an image or a table of the scene is missing, or is no file. The error has the place of
// the first; its message lists the others with their places. replace_missing_images replaces the same files.
void require_images(const Scene& scene);

// A texture without its image becomes 0.5, a normal map nothing. A material without its table becomes
// diffuse. An environment or a goniometric light becomes the same in all directions, a medium by a grid
// nothing. Each gets a diagnostic.
void replace_missing_images(ImportedScene& imported);

}  // namespace vitrail
