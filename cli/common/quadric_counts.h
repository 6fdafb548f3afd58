// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/records/scene.h"

namespace vitrail {

// Counts the quadrics of the scene and of its prototypes: "3 spheres, 2 disks", or "none".
std::string quadric_counts(const Scene& scene);

}  // namespace vitrail
