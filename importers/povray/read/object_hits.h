// SPDX-License-Identifier: Apache-2.0
// These functions find where a line meets an object, and what is inside one: trace() and inside() of POV-Ray.
// They are exact for quadrics, boxes and planes; else of the triangles that the shape becomes.
#pragma once

#include <optional>

#include "importers/povray/read/object.h"

namespace vitrail::pov {

struct Hit {
  double t = 0;
  // It points outwards: a unit vector in the space of the object's parent.
  Vector3d normal;
};

// Returns the first hit with t > 0; `along` has any length. Both are in the space of the object's parent.
// Surfaces that a set or clipped_by cuts away are none.
std::optional<Hit> first_hit(const Object& object, Point3d from, Vector3d along);

// Counts open shapes as closed; a shape that encloses nothing has no inside.
bool is_inside(const Object& object, Point3d p);

}  // namespace vitrail::pov
