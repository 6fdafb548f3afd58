// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/scene.h"

namespace vitrail {

bool is_of_curves(const Scene& scene, const Shape& shape);

// By prototype: whether it holds curves, itself or in prototypes that it uses.
std::vector<bool> prototypes_with_curves(const Scene& scene);

}  // namespace vitrail
