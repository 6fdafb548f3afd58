// SPDX-License-Identifier: Apache-2.0
// A PLY file is binary of either byte order or ASCII, plain or gzipped, with properties in any order and of
// any type.
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Reads the mesh of a PLY file: vertex x y z, nx ny nz, (u v | s t | texture_u texture_v | texture_s
// texture_t), and the lists vertex_indices | vertex_index of faces and of tristrips (-1 ends a strip).
// Polygons become triangles (see shapes/polygon.h), in the order of the file; a face of fewer than three
// corners is dropped. Numbers of normals, (u,v) and attributes that are not finite become 0, with one entry
// in `diagnostics`. Everything else in the file is skipped, but for attributes (ply_attributes.h) where
// they are asked for; `diagnostics`, if given, gets one entry for each property or element skipped. Bad
// input throws Error: in ASCII with the place of the offender, in binary with its byte offset in the
// message and the line of the header that declares it. Memory is claimed only for what the bytes of the
// file can hold.
// `colors` reads those of vertices, or of faces, alone, linear: integers are shares of the greatest of their
// type, in sRGB's encoding.
// `look` reads `colors`, and (u,v) of corners where vertices have none (ply_corner_uvs.h).
// `faces` reads face_indices alone.
enum class PlyAttributes { skip, read, colors, look, faces };
TriangleMesh read_ply(const std::filesystem::path& file, Diagnostics* diagnostics = nullptr,
                      PlyAttributes wanted = PlyAttributes::skip);
// Returns the images that its comments name, as MeshLab writes them ("comment TextureFile wood.png"), in
// order.
std::vector<std::string> texture_files_of_ply(const std::filesystem::path& file);

// It says what pbrt makes of faces of four corners a b c d: v3 the triangles a b c and d a c, v4 bilinear
// patches.
enum class PbrtQuads { v3, v4 };
struct PbrtPly {
  TriangleMesh mesh;  // without the patches
  std::vector<std::array<std::uint32_t, 4>>
      patches;                     // as tessellate_bilinear takes them, of the mesh's vertices
  std::vector<float> patch_faces;  // their face_indices where the file has some, as the triangles have them
};
PbrtPly read_pbrt_ply(const std::filesystem::path& file, PbrtQuads quads, Diagnostics* diagnostics = nullptr);

// It is what the header of a file says: faces count as triangles.
struct PlyCounts {
  std::uint64_t triangles = 0, bytes = 0;  // in memory, without attributes
  std::uint64_t color_bytes = 0;           // of `colors`
  bool has_normals = false;
};
PlyCounts count_ply(const std::filesystem::path& file);

}  // namespace vitrail
