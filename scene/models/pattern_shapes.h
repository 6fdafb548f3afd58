// SPDX-License-Identifier: Apache-2.0
// Patterns without their modifiers: the place in the map, or the number before frequency, phase and wave.
#pragma once

#include <cstddef>

#include "scene/records/pattern_texture.h"

namespace vitrail {

// Of checker, hexagon, brick. `p`: after turbulence.
std::size_t place_of_pattern(const PatternTexture& pattern, Point3d p);
// Places of the kind: 2 or 3.
std::size_t places_of(PatternTexture::Kind kind);

// Of the other kinds. `p`: after turbulence, which marble does by itself.
double number_of_pattern(const PatternTexture& pattern, Point3d p);

// The point of its first tile that stands for p, after turbulence (pattern.cpp).
Point3d moved_in_pattern(const PatternTexture& pattern, Point3d p);

// Of crackle (pattern_crackle.cpp).
double crackle(const PatternTexture& pattern, Point3d p);

}  // namespace vitrail
