// SPDX-License-Identifier: Apache-2.0
#include "cli/common/rectangle.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scene/records/film_extent.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

PixelRect parse_rectangle(const std::string& option, const std::string& text) {
  PixelRect r;
  char end = 0;
  if (std::sscanf(text.c_str(), "%d,%d,%d,%d%c", &r.x0, &r.x1, &r.y0, &r.y1, &end) != 4)
    throw UsageError(option + " takes x0,x1,y0,y1 in pixels, not '" + text + "'");
  return r;
}

PixelSize parse_size(const std::string& option, const std::string& text, PixelSize picture) {
  PixelSize size;
  double percent = 0;
  char end = 0, sign = 0;
  const auto in_proportion = [&](double scale) {
    const auto of = [&](int extent) { return std::max(1, static_cast<int>(std::lround(scale * extent))); };
    return PixelSize{of(picture.width), of(picture.height)};
  };
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &end) != 2) {
    if (std::sscanf(text.c_str(), "%lf%c%c", &percent, &sign, &end) == 2 && sign == '%' && percent > 0 &&
        percent <= 1e4)
      size = in_proportion(percent / 100);
    else if (std::sscanf(text.c_str(), "%d%c", &size.width, &end) == 1)
      size.height = in_proportion(static_cast<double>(size.width) / picture.width).height;
    else
      size = {};
  }
  if (size.width < 1 || size.width > max_film_extent || size.height < 1 || size.height > max_film_extent)
    throw UsageError(option + " takes WIDTHxHEIGHT, a WIDTH or a PERCENT%, not '" + text + "'");
  return size;
}

}  // namespace vitrail
