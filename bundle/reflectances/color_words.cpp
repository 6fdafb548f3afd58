// SPDX-License-Identifier: Apache-2.0
#include "bundle/reflectances/color_words.h"

#include "bundle/reflectances/reflectance_table.h"

namespace vitrail {

TexelWords reflectance_words(const std::array<float, 3>& color, const ReflectanceFitter& fitter) {
  if (const auto nodes = tabulated_reflectance(color)) return pack({*nodes});
  return pack({fitter(
      {static_cast<double>(color[0]), static_cast<double>(color[1]), static_cast<double>(color[2])})});
}

TexelWords color_words(std::uint32_t word, std::span<const float> values, const ReflectanceFitter& fitter) {
  return reflectance_words({values[word & 0xff], values[word >> 8 & 0xff], values[word >> 16 & 0xff]},
                           fitter);
}

}  // namespace vitrail
