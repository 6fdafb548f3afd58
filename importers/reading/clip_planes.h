// SPDX-License-Identifier: Apache-2.0
// Cameras have near and far planes. Most files have some that cut nothing away.
#pragma once

#include "scene/records/scene.h"

namespace vitrail {

// Returns lengths in the world, both powers of ten or the usual ones of Mitsuba: nothing of the scene is
// farther from the camera than the far one, and the near one is less than 10⁻⁵ of twice the diagonal around
// scene and camera.
ClipRange wide_clip(const Scene& scene, const Transform& camera_to_world);

// Gives the camera those of the planes that cut away something that is in its picture. Where the camera
// stands in a medium the near one stays, since it shortens the way through that. Moving objects count where
// they are when the shutter opens.
void keep_clip(Scene& scene, const ClipRange& planes);

}  // namespace vitrail
