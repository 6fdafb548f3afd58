// SPDX-License-Identifier: Apache-2.0
// A mesh has a front. In the Scene the winding says which side it is; in Mitsuba the geometric normal follows
// the winding too, but BSDFs and area lights go by the shading normal.
#pragma once

#include <string>

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

struct MeshFile {
  std::string filename;  // relative to the scene's
  bool flip_normals = false;
};

// Returns the mesh of `shape` so that Mitsuba sees the same front; `sides_matter` where that can be seen. It
// is a mesh of the Scene, unless shading normals point behind the front.
MeshFile mesh_file(Context& context, const Shape& shape, bool sides_matter);

// Returns a copy of the mesh right behind it that faces backwards.
MeshFile back_of(Context& context, const Shape& shape);

}  // namespace vitrail::mitsuba_writer
