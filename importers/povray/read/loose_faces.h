// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/records/scene.h"

namespace vitrail::pov {

// Turns the faces of glass outward, where triangles of one material and interior close a surface together but
// are not all wound alike: POV-Ray asks whether a ray is in the interior already, and not how a face is
// wound. The shapes are the scene's or a prototype's. A surface whose faces are wound alike stays as it is:
// it may bound a hollow.
void turn_glass_out(Scene& scene, const std::vector<Shape>& shapes);

}  // namespace vitrail::pov
