// SPDX-License-Identifier: Apache-2.0
// This file tells whether the lamps of a scene light it.
#pragma once

#include "scene/geometry/bounds.h"
#include "scene/records/scene.h"

namespace vitrail {

// Returns how bright the lamps make the scene in a picture. It is the greater of two values: a white surface
// that faces a far light shows the one; a white box around the scene that takes up the power of all other
// lamps shows the other on average. Images count by their means. It is infinite where that cannot be told,
// and where a lamp itself shows ten times white or more on average: it is meant as a lamp, however small it
// is. `bounds` are the scene's.
double brightness_of_lamps(const Scene& scene, const Bounds3d& bounds);

}  // namespace vitrail
