// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tracer/rays/ray.h"

namespace vitrail {

// Returns where the point p of an object hit at `from_s` is at `to_s`, in the bundle's coordinates. It is p
// itself where nothing that holds it moves. `domain` holds the hit.
Point3d moved_point(const DomainView& domain, const Hit& hit, Point3d p, double from_s, double to_s);

}  // namespace vitrail
