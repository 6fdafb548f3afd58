// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

bool is_of_curves(const Scene& scene, const Shape& shape);

// Of each wall of a tube in the place of a curve: a ray meets both, where it meets the curve once.
float opacity_of_wall(float opacity_of_curve);

// By prototype: whether it holds curves, itself or in prototypes that it uses.
std::vector<bool> prototypes_with_curves(const Scene& scene);

}  // namespace vitrail
