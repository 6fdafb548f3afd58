// SPDX-License-Identifier: Apache-2.0
// Grids of media are written as POV-Ray's density files.
#pragma once

#include <string>
#include <vector>

#include "importers/povray/write/context.h"

namespace vitrail::povray {

// It multiplies coefficients from place to place: `color` times a density of 0 to 1.
struct DensityPart {
  std::string density;  // "density { density_file df3 … }"
  RGB color;
};

// Writes the grid as DF3 files beside the scene's images: one of a grid of numbers, else one for each channel
// that is not 0. Values are kept in 1/65535 of the greatest. They are linear between the centres of cells;
// half a cell beyond its bounds as at its edge, then 0. Throws Error where the grid's file is not read, or it
// has more cells along a side than DF3 has (65535).
std::vector<DensityPart> density_parts(Context& context, const Grid& grid, const Transform& medium_to_world);

}  // namespace vitrail::povray
