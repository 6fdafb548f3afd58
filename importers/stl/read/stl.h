// SPDX-License-Identifier: Apache-2.0
// An STL file has triangles, as text or binary.
#pragma once

#include <filesystem>

#include "scene/shapes/mesh.h"

namespace vitrail {

// It is the attribute of the colours of facets, where the file has some.
inline constexpr const char* stl_color = "face_color";

// Reads a mesh. Equal vertices become one, so that closed surfaces are known; the normals of facets, which
// say nothing that their corners do not, are left out. Colours are those of VisCAM or, where the header has a
// colour of all, of Materialise; a facet without one is grey .5 then. A file is binary by the size that it
// states. Throws Error with the place: a file that ends within a facet, words or numbers that are none,
// positions that are not finite, no facet with an area.
TriangleMesh read_stl(const std::filesystem::path& file);

}  // namespace vitrail
