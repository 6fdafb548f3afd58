// SPDX-License-Identifier: Apache-2.0
#include "film/alpha.h"

#include <algorithm>

namespace vitrail {

const PictureChannel* alpha_of(const Picture& picture) {
  const auto found =
      std::ranges::find(picture.layers, kind_of(Layer::alpha).channels[0], &PictureChannel::name);
  return found == picture.layers.end() ? nullptr : &*found;
}

void make_straight(Picture& picture) {
  const PictureChannel* const covers = alpha_of(picture);
  if (!covers) return;
  std::vector<float>& values =
      picture.layers[static_cast<std::size_t>(covers - picture.layers.data())].values;
  for (std::size_t p = 0; p < picture.rgb.pixels(); ++p) {
    float& alpha = values[p];
    alpha = std::clamp(alpha, 0.0f, 1.0f);
    for (std::size_t c = 0; c < 3; ++c) {
      float& value = picture.rgb.values[3 * p + c];
      value = alpha > 0 ? value / alpha : 0;
    }
  }
}

}  // namespace vitrail
