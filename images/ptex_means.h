// SPDX-License-Identifier: Apache-2.0
// These functions evaluate Ptex's textures, one number at a time or by a mean over all faces.
#pragma once

#include <string>

#include "scene/records/texture.h"
#include "scene/spectra/color.h"

namespace vitrail {

// Returns the value of a number as the file has it. pbrt decodes the filtered texels, from a gamma of 2.2
// unless the scene says otherwise. A number that is not finite counts as 0.
double ptex_value(double value, const PtexTexture& texture);

// It stands for the texture where faces are not told apart: the mean of its faces, or grey where its
// file cannot be read. `how` says which, and how far faces are from it: `deviation` in the root mean
// square.
struct PtexMean {
  RGB color;
  std::string how;
  double deviation = 0;
};
PtexMean mean_of_ptex(const PtexTexture& texture);

}  // namespace vitrail
