// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/records/material_traits.h"
#include "scene/records/scene.h"

namespace vitrail {

bool is_of_curves(const Scene& scene, const Shape& shape);

// It says how the inner wall of a tube differs from the outer one. A ray meets both walls of a tube, where it
// meets the curve once. So the inner wall is nothing where the surface can be so (TwoSidedMaterial): a fibre
// is so by itself, a material that transmits is not.
enum class InnerWall : std::uint8_t { as_the_outer, nothing, nothing_by_itself };
InnerWall inner_wall(const MaterialTraits& material);

// Returns the opacity of each wall where both are alike and together let through as much as the curve. They
// scatter less than it: light that is scattered within is lost.
float opacity_of_wall(float opacity_of_curve);

// Returns for each prototype whether it holds curves, itself or in prototypes that it uses.
std::vector<bool> prototypes_with_curves(const Scene& scene);

}  // namespace vitrail
