// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Writes OUT.obj and OUT.mtl (write_mtl.h): every shape as an object of its own, in world space, fronts
// counter-clockwise; instances are flattened. Positions of shapes that are not moved are the mesh's own
// floats, of others doubles, so that read_obj gives meshes and places of its own back bit for bit. (It makes
// one mesh of all shapes of one material. Where it moves a file that lies far from the origin, vertices of
// that file that no face uses, which are not written, may make that place another one.) The camera, lights
// besides Ke, media and attributes are dropped. Throws MachineError.
Diagnostics write_obj(const Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
