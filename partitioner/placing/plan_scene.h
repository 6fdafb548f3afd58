// SPDX-License-Identifier: Apache-2.0
// The plan decides which prototypes become objects, and where they stand. It depends on the scene alone: a
// scene whose instances are kept and the same scene flattened are made of the same objects.
#pragma once

#include "partitioner/placing/objects.h"
#include "scene/records/scene.h"

namespace vitrail {

// A prototype becomes an object where it moves, or where references to it take fewer bytes than copies of it.
// So do shapes that share a mesh (shared_shapes.h). Shapes under a singular, projective or extreme transform
// are copied, quadrics as triangles. Others are objects, one for all that are alike but for where they stand.
// Throws Error for vertices that are not finite where they stand, and for more than 2³² − 5 triangles that
// are no instances' (triangle_number.h).
ScenePlan plan_scene(const Scene& scene);

}  // namespace vitrail
