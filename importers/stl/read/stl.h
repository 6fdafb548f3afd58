// SPDX-License-Identifier: Apache-2.0
// STL: triangles alone, as text or binary.
#pragma once

#include <filesystem>

#include "scene/shapes/mesh.h"

namespace vitrail {

// Equal vertices become one, so that what is closed can be known; the normals of facets, which say nothing
// that their corners do not, and colours are left out. Which of the two it is, is known by the size that a
// binary file states. Throws Error with the place: a file that ends within a facet, words or numbers that are
// none, positions that are not finite.
TriangleMesh read_stl(const std::filesystem::path& file);

}  // namespace vitrail
