// SPDX-License-Identifier: Apache-2.0
// These functions test lines and points against the shape of an object that is no group, in its own space.
#pragma once

#include <vector>

#include "importers/povray/read/object_hits.h"
#include "importers/povray/read/triangle_tree.h"

namespace vitrail::pov {

// Returns the tree of a mesh or solid, made once and shared by copies. Throws Error where the shape does.
const TriangleTree& tree_of(const Object& object);

// Adds all hits with t > 0. Normals point outwards and have any length.
void hits_of_shape(const Object& object, const Line& line, std::vector<Hit>& hits);
bool is_inside_shape(const Object& object, Point3d p);

}  // namespace vitrail::pov
