// SPDX-License-Identifier: Apache-2.0
// This reader takes Wavefront OBJ with its MTL libraries, plain or gzipped.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// Reads polygons, their normals and texture coordinates. There is one mesh and one shape for each object and
// material (two or more where some of its faces have normals or texture coordinates and others have not), by
// material first. Shapes have the names of their objects: of o where the file has several, else of g. Each
// object that shines has a lamp, named after it, or after its material where it has several of these.
// Vertices are in the order of the file where all corners have one index for everything, else in that of
// their use. Faces have materials (mtl.h); those without one are diffuse, of the colours of their vertices (v
// x y z r g b, in sRGB's encoding), else 0.5. Faces without normals in a smoothing group get normals
// (obj_smoothing.h). The camera and the lights besides Ke are left at their defaults. A file that lies far
// from the origin is moved to it, its place kept in object_to_world: vertices are floats. Points, lines,
// curves and surfaces are dropped with diagnostics; wrong indices and numbers throw Error. A face with vertex
// index 0 can only come from a program that counts from 0: the whole file is then read so.
ImportedScene read_obj(const std::filesystem::path& file);

// It has the geometry alone, whatever its materials and wherever it lies.
struct ObjGeometry {
  std::vector<TriangleMesh> meshes;  // by whether their faces have normals and texture coordinates
  // They are those of usemtl, one for each mesh: "" where there is none, and for all where they are not asked
  // for.
  std::vector<std::string> materials;
  Diagnostics diagnostics;
};
// Reads without smoothing groups and colours of vertices, too.
ObjGeometry read_obj_geometry(const std::filesystem::path& file, bool by_material = false);

}  // namespace vitrail
