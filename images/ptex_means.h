// SPDX-License-Identifier: Apache-2.0
// Ptex: a texture for every face of a mesh. Its files hold the mean of each face beside the texels (Ptex File
// Format Specification 1.3, "Constant Data"); the texels are not read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/color.h"
#include "scene/texture.h"

namespace vitrail {

struct PtexMeans {
  int channels = 0;
  std::vector<float> values;  // channels × faces, as the file stores them; integers taken to [0,1]
};

// Throws Error with the file's name.
PtexMeans read_ptex_means(const std::filesystem::path& file);

// What stands for the texture where faces are not told apart: the mean of its faces, or grey where its file
// cannot be read. `how` says which, and how far faces are from it.
struct PtexMean {
  RGB color;
  std::string how;
};
PtexMean mean_of_ptex(const PtexTexture& texture);

}  // namespace vitrail
