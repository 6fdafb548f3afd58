// SPDX-License-Identifier: Apache-2.0
// What scenes ask of objects while they are read.
#pragma once

#include "importers/povray/read/token.h"
#include "scene/geometry/bounds.h"
#include "scene/geometry/transform.h"

namespace vitrail::pov {

class Reader;

// The box of what the object is made of, before its transformation; of what has no end, ±1e7.
const Bounds3d& own_box(const Object& object);
// That box under the transformation: min_extent() and max_extent(). What is inverse keeps it.
Bounds3d extents_of(const Object& object);

// What of the space around its parent the object may fill: of a plane across an axis its half.
Bounds3d region_of(const Object& object);

// The box of a box that is transformed; nothing of nothing.
Bounds3d moved_box(const Bounds3d& box, const Transform& t);

}  // namespace vitrail::pov
