// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Writes a scene in the format that the name of `out` ends in: .pbrt (v4), .xml (Mitsuba 3), .pov
// (POV-Ray 3.7), .glb or .gltf (glTF 2.0), .obj or .ply. Meshes and images go into folders beside it. What
// the format cannot say exactly is in the diagnostics, each with the place where its record comes from. An
// unknown format throws UsageError, a full disk and the like MachineError.
Diagnostics export_scene(const Scene& scene, const std::filesystem::path& out);

// Returns whether a surface has a material for each side in the format of `out`: it has in Mitsuba's and
// POV-Ray's.
bool has_materials_by_side(const std::filesystem::path& out);

// Throws UsageError unless export_scene knows the format.
void require_export_format(const std::filesystem::path& out);

}  // namespace vitrail
