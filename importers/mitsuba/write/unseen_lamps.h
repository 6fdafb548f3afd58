// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/records/scene.h"

namespace vitrail {

// Whether the written integrator hides what shines from the camera: as the scene says, or where nothing meets
// any of its lamps (Shape::opacity) and there are no surroundings that would be hidden with them.
bool hides_emitters(const Scene& scene);

}  // namespace vitrail
