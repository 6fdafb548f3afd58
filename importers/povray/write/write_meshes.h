// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "importers/writing/text_sink.h"
#include "scene/records/scene.h"

namespace vitrail::povray {

// It is everything between the braces of a mesh2: the triangles that `to_pov` makes of the shape's mesh.
// Their outside (where POV-Ray applies `texture`, not `interior_texture`) is the shape's front. Triangles
// without area are left out; uvs are written if `with_uvs`.
struct MeshText {
  const TriangleMesh& mesh;
  Transform to_pov;
  bool flip = false;  // the front is where the triangles run clockwise after the transform
  bool with_uvs = false;
};

// Returns the beginning of the object, up to its texture, that is what the shape's quadric is after `to_pov`;
// "" where POV-Ray has none or would need uvs.
std::string quadric_text(const MeshText& text);

// Returns whether the shape's quadric is of curves that sphere sweeps can be.
bool has_sweeps(const MeshText& text);
// Writes the hulls of balls along the curves. Returns whether all end round, as sweeps do.
bool put_sweeps(const MeshText& text, TextSink& out);

// Returns whether the surface is closed and its front looks inwards.
bool is_inside_out(const MeshText& text);

// Returns false where no triangle has an area: POV-Ray refuses such a mesh.
bool has_area(const MeshText& text);
std::string mesh_text(const MeshText& text);
// Writes the same into a file, in pieces. Throws MachineError.
void write_mesh_text(const MeshText& text, const std::filesystem::path& file);

// It is a parallelogram with right angles; edges run from the corner.
struct Rectangle {
  Point3d corner;
  Vector3d edge_u, edge_v;
  Vector3d front;  // unit
};

// Returns the figure that two triangles of a mesh form, if that is a rectangle.
std::optional<Rectangle> rectangle_of(const MeshText& text);

}  // namespace vitrail::povray
