// SPDX-License-Identifier: Apache-2.0
// FreeType gives the outlines of a font's letters. It is loaded with the first font.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail::solids {

struct Glyph {
  std::vector<std::vector<Point2d>> contours;  // Bézier segments of four points each; an em is 1
  double advance = 0;                          // to the next letter, with the kerning between the two
};

// Returns one a letter; those that the font has not are empty and have no width. Throws Error where FreeType
// is not installed or does not read the file.
std::vector<Glyph> outlines(const std::string& font_file, std::string_view utf8);

}  // namespace vitrail::solids
