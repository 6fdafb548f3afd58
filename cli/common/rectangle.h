// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/records/film_settings.h"

namespace vitrail {

// "x0,x1,y0,y1", in pixels. Anything else throws UsageError, which names the option.
PixelRect parse_rectangle(const std::string& option, const std::string& text);

}  // namespace vitrail
