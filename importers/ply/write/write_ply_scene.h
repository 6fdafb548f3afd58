// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// All shapes as one mesh (write_ply.h) in world space, fronts counter-clockwise; instances are flattened.
// Where only some have shading normals, the triangles of the others get corners of their own with the
// triangle's normal, so that all look as they did; missing uvs are 0. Materials, lights and the camera are
// dropped, which is reported. More than 2³¹ − 1 vertices throw Error; failures to write MachineError.
Diagnostics write_ply_scene(const Scene& scene, const std::filesystem::path& file);

}  // namespace vitrail
