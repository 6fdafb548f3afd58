// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/shapes/mesh.h"

namespace vitrail {

// Writes binary little-endian PLY: float x y z [nx ny nz] [u v] [attributes by vertex], then faces `uchar
// int` vertex_indices [attributes by face]. The channels of an attribute "vertex_NAME" or "face_NAME" are
// properties NAME_0, NAME_1 … of its element, as Mitsuba reads them; face_indices keep their name. read_ply
// gives the same mesh back, bit for bit. Throws MachineError.
void write_ply(const TriangleMesh& mesh, const std::filesystem::path& file);
// Writes the same as a part of a scene (AtomicFile::commit_part).
void write_ply_part(const TriangleMesh& mesh, const std::filesystem::path& file);

}  // namespace vitrail
