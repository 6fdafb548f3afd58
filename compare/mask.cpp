// SPDX-License-Identifier: Apache-2.0
#include "compare/mask.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

template <class T>
std::vector<T> remaining(const std::vector<T>& values, const Mask& mask) {
  const std::size_t each = values.size() / mask.size();
  std::vector<T> result;
  for (std::size_t p = 0; p < mask.size(); ++p)
    if (!mask[p])
      for (std::size_t c = 0; c < each; ++c) result.push_back(values[each * p + c]);
  return result;
}

}  // namespace

Mask make_mask(int width, int height, std::span<const PixelRect> ignored, const Image& kept) {
  const auto columns = static_cast<std::size_t>(width);
  Mask mask(columns * static_cast<std::size_t>(height), false);
  if (kept.pixels() > 0) {
    if (kept.width != width || kept.height != height)
      throw Error(
          fmt::format("the mask has {}×{} pixels, the images {}×{}", kept.width, kept.height, width, height));
    const auto channels = static_cast<std::size_t>(kept.channels);
    for (std::size_t p = 0; p < mask.size(); ++p) {
      const auto first = kept.values.begin() + static_cast<std::ptrdiff_t>(channels * p);
      mask[p] = std::all_of(first, first + kept.channels, [](float v) { return v == 0; });
    }
  }
  for (const PixelRect& r : ignored) {
    if (r.x0 < 0 || r.y0 < 0 || r.x1 > width || r.y1 > height || r.x0 >= r.x1 || r.y0 >= r.y1)
      throw Error(fmt::format("the rectangle {},{},{},{} is empty or leaves the image of {}×{} pixels", r.x0,
                              r.x1, r.y0, r.y1, width, height));
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x)
        mask[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)] = true;
  }
  if (std::find(mask.begin(), mask.end(), false) == mask.end())
    throw Error("every pixel is left out of the comparison");
  return mask;
}

Image without(const Image& image, const Mask& mask) {
  Image result{0, 1, image.channels, remaining(image.values, mask)};
  result.width = static_cast<int>(std::count(mask.begin(), mask.end(), false));
  return result;
}

std::vector<double> without(const std::vector<double>& values, const Mask& mask) {
  return remaining(values, mask);
}

std::vector<int> without(const std::vector<int>& values, const Mask& mask) { return remaining(values, mask); }

std::vector<double> spread(const std::vector<double>& values, const Mask& mask) {
  std::vector<double> result(mask.size(), 0.0);
  auto next = values.begin();
  for (std::size_t p = 0; p < mask.size(); ++p)
    if (!mask[p]) result[p] = *next++;
  return result;
}

}  // namespace vitrail
