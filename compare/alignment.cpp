// SPDX-License-Identifier: Apache-2.0
#include "compare/alignment.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/metrics.h"
#include "film/picture_extent.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

std::string in_words(const PixelRect& r) { return fmt::format("{},{},{},{}", r.x0, r.x1, r.y0, r.y1); }

}  // namespace

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
