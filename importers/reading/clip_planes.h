// SPDX-License-Identifier: Apache-2.0
// Near and far planes of cameras: most files have some that cut nothing away.
#pragma once

#include "scene/records/scene.h"

namespace vitrail {

// Lengths in the world, both powers of ten or the usual ones of Mitsuba: nothing of the scene is farther from
// the camera, and what is nearer is less than 10⁻⁵ of it.
ClipRange wide_clip(const Scene& scene, const Transform& camera_to_world);

// Gives the camera those of the planes that cut away something that is in its picture. Where it stands in a
// medium, the near one shortens the way through that. What moves is where it is when the shutter opens.
void keep_clip(Scene& scene, const ClipRange& planes);

}  // namespace vitrail
