// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/mesh.h"

namespace vitrail {

// Binary little-endian PLY: float x y z [nx ny nz] [u v] [attributes by vertex], then faces `uchar int`
// vertex_indices [attributes by face]. A channel of an attribute is a property NAME_0, NAME_1 … (NAME alone
// where there is one). read_ply gives the same mesh back, bit for bit. Throws MachineError.
void write_ply(const TriangleMesh& mesh, const std::filesystem::path& file);

}  // namespace vitrail
