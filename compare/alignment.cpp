// SPDX-License-Identifier: Apache-2.0
#include "compare/alignment.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/metrics.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// `window` is relative to the image.
Image part_of(const Image& image, const PixelRect& window) {
  if (image.pixels() == 0) return image;
  Image part = black_image(window.x1 - window.x0, window.y1 - window.y0, image.channels);
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t row_values = channels * static_cast<std::size_t>(part.width);
  for (int y = 0; y < part.height; ++y) {
    const std::size_t pixel =
        static_cast<std::size_t>(window.y0 + y) * static_cast<std::size_t>(image.width) +
        static_cast<std::size_t>(window.x0);
    std::copy_n(image.values.begin() + static_cast<std::ptrdiff_t>(channels * pixel), row_values,
                part.values.begin() + static_cast<std::ptrdiff_t>(row_values * static_cast<std::size_t>(y)));
  }
  return part;
}

std::string in_words(const PixelRect& r) { return fmt::format("{},{},{},{}", r.x0, r.x1, r.y0, r.y1); }

}  // namespace

void cut_to(Picture& picture, const PixelRect& window) {
  const PixelRect& own = picture.window;
  if (window == own) return;
  const PixelRect inside{window.x0 - own.x0, window.x1 - own.x0, window.y0 - own.y0, window.y1 - own.y0};
  for (Image* image : {&picture.rgb, &picture.variance, &picture.spectrum}) *image = part_of(*image, inside);
  picture.window = window;
}

void align(Picture& image, Picture& reference) {
  const PixelRect &a = image.window, &b = reference.window;
  const bool same_whole =
      image.full_width == reference.full_width && image.full_height == reference.full_height;
  if (!same_whole) return require_same_size(image.rgb, reference.rgb);
  const PixelRect both{std::max(a.x0, b.x0), std::min(a.x1, b.x1), std::max(a.y0, b.y0),
                       std::min(a.y1, b.y1)};
  if (both.x0 >= both.x1 || both.y0 >= both.y1)
    throw Error(fmt::format("the pictures show different parts of the whole: {} and {} (x0,x1,y0,y1)",
                            in_words(a), in_words(b)));
  cut_to(image, both);
  cut_to(reference, both);
}

}  // namespace vitrail
