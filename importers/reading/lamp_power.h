// SPDX-License-Identifier: Apache-2.0
// Whether what shines in a scene lights it.
#pragma once

#include "scene/geometry/bounds.h"
#include "scene/records/scene.h"

namespace vitrail {

// Returns how bright the lamps make the scene, as a picture shows it: the greatest of what a white surface
// that faces a far light shows, and of what a white box around the scene shows on average that takes up the
// power of all other lamps. Images count by their means. It is infinite where that cannot be told, and where
// a lamp itself shows ten times white or more on average: that is meant as one, however small it is. `bounds`
// are the scene's.
double brightness_of_lamps(const Scene& scene, const Bounds3d& bounds);

}  // namespace vitrail
