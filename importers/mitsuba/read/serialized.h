// SPDX-License-Identifier: Apache-2.0
// A file of Mitsuba's binary meshes holds several: each is
//   uint16 0x041C, uint16 version (3 or 4), then one zlib stream:
//     uint32 flags (1 normals, 2 texture coordinates, 8 colours, 0x10 face normals, 0x1000 float, 0x2000
//     double), version 4: a name that ends with a zero byte; uint64 vertices, uint64 triangles; positions,
//     normals, texture coordinates, colours; three uint32 a triangle
// and behind them their offsets (uint64; version 3: uint32) and their number (uint32). Little-endian.
#pragma once

#include <filesystem>

#include "scene/shapes/mesh.h"

namespace vitrail::mitsuba {

// Reads the mesh number `index`. Colours are left out. Throws Error with the byte of the file where that mesh
// begins: for values that are truncated, out of range or not finite, and for counts for which the file has no
// bytes.
TriangleMesh read_serialized(const std::filesystem::path& file, int index);

}  // namespace vitrail::mitsuba
