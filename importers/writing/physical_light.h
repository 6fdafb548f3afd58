// SPDX-License-Identifier: Apache-2.0
// Lights that fade as POV-Ray's are written to formats whose lights weaken as 1/d².
#pragma once

#include <optional>
#include <string>

#include "scene/records/scene.h"

namespace vitrail {

// It holds the `factor` by which to multiply the intensity of a light that weakens as 1/d², so that it is as
// bright at the middle of the scene.
struct PhysicalLight {
  double factor = 1;
  std::string note;  // what that changes elsewhere; "" where nothing
};
PhysicalLight physical_light(const Scene& scene, const std::optional<Fading>& fading, Point3d position);

}  // namespace vitrail
