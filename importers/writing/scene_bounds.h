// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/geometry/bounds.h"
#include "scene/records/scene.h"

namespace vitrail {

// Returns the bounds of all shapes and instances, in the world.
Bounds3d bounds_of_shapes(const Scene& scene);

}  // namespace vitrail
