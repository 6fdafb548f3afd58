// SPDX-License-Identifier: Apache-2.0
// Lights that fade as POV-Ray's, in formats whose lights weaken as 1/d².
#pragma once

#include <optional>
#include <string>

#include "scene/records/scene.h"

namespace vitrail {

// A light that weakens as 1/d² is as bright at the middle of the scene with `factor` times the intensity.
struct PhysicalLight {
  double factor = 1;
  std::string note;  // what that changes elsewhere; "" where nothing
};
PhysicalLight physical_light(const Scene& scene, const std::optional<Fading>& fading, Point3d position);

}  // namespace vitrail
