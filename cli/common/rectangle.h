// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/records/film_settings.h"

namespace vitrail {

// Reads "x0,x1,y0,y1", in pixels. Anything else throws UsageError, which names the option.
PixelRect parse_rectangle(const std::string& option, const std::string& text);

struct PixelSize {
  int width = 0, height = 0;
};

// Reads "640x360", "640" (the height in proportion) or "50%" of a picture. Anything else, and sizes that no
// film has, throw UsageError, which names the option.
PixelSize parse_size(const std::string& option, const std::string& text, PixelSize picture);

}  // namespace vitrail
