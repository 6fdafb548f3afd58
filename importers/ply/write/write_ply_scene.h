// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Writes all shapes as one mesh (write_ply.h) in world space, fronts counter-clockwise; instances are
// flattened. Where only some have shading normals, the triangles of the others get corners of their own with
// the triangle's normal, so that all look as they did; missing uvs are 0. Materials, lights and the camera
// are dropped, which is reported. Throws Error for more than 2³¹ − 1 vertices, and MachineError where it
// cannot write.
Diagnostics write_ply_scene(const Scene& scene, const std::filesystem::path& file);

}  // namespace vitrail
