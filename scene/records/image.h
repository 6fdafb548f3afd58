// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace vitrail {

// Its values are height × width × channels, interleaved, the top left pixel first. The channels are Y, Y and
// alpha, RGB, or RGB and alpha; alpha is not multiplied into the others. Unless said otherwise the values are
// linear, and colours linear sRGB.
struct Image {
  int width = 0, height = 0, channels = 3;
  std::vector<float> values;

  // has_alpha is true for 2 or 4 channels; pixels returns width × height.
  bool has_alpha() const { return channels == 2 || channels == 4; }
  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  bool operator==(const Image&) const = default;
};

// Returns an image whose values are all 0.
inline Image black_image(int width, int height, int channels) {
  Image image{width, height, channels, {}};
  image.values.resize(image.pixels() * static_cast<std::size_t>(channels));
  return image;
}

}  // namespace vitrail
