// SPDX-License-Identifier: Apache-2.0
// One door for all formats.
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace vitrail {

// Reads a scene in the format that the file name says (.pbrt, .pbrt.gz, .obj, .ply). Bad input throws Error
// with its place. A file of geometry alone gets a camera that sees all of it and a constant sky, and
// diagnostics that say so.
ImportedScene import_scene(const std::filesystem::path& file);

}  // namespace vitrail
