// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/geometry/pi.h"
#include "scene/geometry/vec.h"

namespace vitrail {

// Returns (cos, sin) of an angle in [0, 2π] rad, within 4e-16. It uses + − × only: the C library's own differ
// in their last bit between processors, and tessellations have to be equal everywhere. It is exact at the
// multiples of π/2 given as doubles.
Point2d unit_circle(double angle_rad);

}  // namespace vitrail
