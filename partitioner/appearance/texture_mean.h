// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/scene.h"

namespace vitrail {

// The one value that stands for a parameter: its own, or about the mean of what its texture shows (images
// count as 0.5). `is_exact` says whether the parameter is that value everywhere.
struct MeanSpectrum {
  Spectrum value;
  bool is_exact = true;
};
struct MeanFloat {
  double value = 0;
  bool is_exact = true;
};

// Of every texture of a scene.
class TextureMeans {
 public:
  explicit TextureMeans(const std::vector<Texture>& textures);
  MeanSpectrum of(const SpectrumParameter& parameter) const;
  MeanFloat of(const FloatParameter& parameter) const;

 private:
  std::vector<MeanSpectrum> means_;
};

}  // namespace vitrail
