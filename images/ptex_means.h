// SPDX-License-Identifier: Apache-2.0
// What Ptex's textures count as.
#pragma once

#include <string>

#include "scene/records/texture.h"
#include "scene/spectra/color.h"

namespace vitrail {

// Of a number as its file has it. pbrt decodes what its filters make of the texels, from a gamma of 2.2
// unless the scene says otherwise. What is not finite counts as 0.
double ptex_value(double value, const PtexTexture& texture);

// What stands for the texture where faces are not told apart: the mean of its faces, or grey where its file
// cannot be read. `how` says which, and how far faces are from it:
// `deviation` in the root mean square.
struct PtexMean {
  RGB color;
  std::string how;
  double deviation = 0;
};
PtexMean mean_of_ptex(const PtexTexture& texture);

}  // namespace vitrail
