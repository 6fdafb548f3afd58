// SPDX-License-Identifier: Apache-2.0
// Scenes ask for these boxes of objects while they are read.
#pragma once

#include "importers/povray/read/token.h"
#include "scene/geometry/bounds.h"
#include "scene/geometry/transform.h"

namespace vitrail::pov {

class Reader;

// Returns the box of the object's shape before its transformation; of a shape without end, ±1e7.
const Bounds3d& own_box(const Object& object);
// Returns that box under the transformation: min_extent() and max_extent(). Inverse objects keep it.
Bounds3d extents_of(const Object& object);

// Returns where around its parent the object may lie: of a plane across an axis the half of the space.
Bounds3d region_of(const Object& object);

// Returns the box of a box that is transformed; an empty one stays empty.
Bounds3d moved_box(const Bounds3d& box, const Transform& t);

}  // namespace vitrail::pov
