// SPDX-License-Identifier: Apache-2.0
#include "cli/common/rectangle.h"

#include <cstdio>

#include "scene/system/diagnostics.h"

namespace vitrail {

PixelRect parse_rectangle(const std::string& option, const std::string& text) {
  PixelRect r;
  char end = 0;
  if (std::sscanf(text.c_str(), "%d,%d,%d,%d%c", &r.x0, &r.x1, &r.y0, &r.y1, &end) != 4)
    throw UsageError(option + " takes x0,x1,y0,y1 in pixels, not '" + text + "'");
  return r;
}

}  // namespace vitrail
