// SPDX-License-Identifier: Apache-2.0
// Where a line meets an object, and what is inside one: trace() and inside() of POV-Ray's documentation.
// Exact for quadrics, boxes and planes; else of the triangles that the shape becomes.
#pragma once

#include <optional>

#include "importers/povray/read/object.h"

namespace vitrail::pov {

struct Hit {
  double t = 0;
  // Outwards, a unit vector in the space of the object's parent.
  Vector3d normal;
};

// The first hit with t > 0; `along` has any length. Both of the space of the object's parent. Surfaces that a
// set or clipped_by cuts away are none.
std::optional<Hit> first_hit(const Object& object, Point3d from, Vector3d along);

// Open shapes count as closed; what encloses nothing has no inside.
bool is_inside(const Object& object, Point3d p);

}  // namespace vitrail::pov
