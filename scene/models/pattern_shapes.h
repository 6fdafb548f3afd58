// SPDX-License-Identifier: Apache-2.0
// These are patterns without their modifiers: the place in the map, or the number before frequency, phase and
// wave.
#pragma once

#include <cstddef>

#include "scene/records/pattern_texture.h"

namespace vitrail {

// Returns the place for checker, hexagon and brick. `p` is after turbulence.
std::size_t place_of_pattern(const PatternTexture& pattern, Point3d p);
// Returns how many places the kind has: 2 or 3.
std::size_t places_of(PatternTexture::Kind kind);

// Returns the number for the other kinds. `p` is after turbulence, which marble does by itself.
double number_of_pattern(const PatternTexture& pattern, Point3d p);

// Returns the point of its first tile that stands for p, after turbulence (pattern.cpp).
Point3d moved_in_pattern(const PatternTexture& pattern, Point3d p);

// Returns the number of the crackle pattern (pattern_crackle.cpp).
double crackle(const PatternTexture& pattern, Point3d p);

}  // namespace vitrail
