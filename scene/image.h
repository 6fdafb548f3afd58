// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace vitrail {

// Linear values, height × width × channels, interleaved, the top left pixel first. Colours are linear sRGB.
struct Image {
  int width = 0, height = 0, channels = 3;
  std::vector<float> values;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  bool operator==(const Image&) const = default;
};

inline Image black_image(int width, int height, int channels) {
  Image image{width, height, channels, {}};
  image.values.resize(image.pixels() * static_cast<std::size_t>(channels));
  return image;
}

}  // namespace vitrail
