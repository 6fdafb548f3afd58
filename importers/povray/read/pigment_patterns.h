// SPDX-License-Identifier: Apache-2.0
// The colour of a pigment as the number of a pattern.
#pragma once

#include <optional>
#include <vector>

#include "importers/povray/read/surface.h"

namespace vitrail::pov {

// As povray weighs red, green and blue.
double grey_of(const Numbers& color);

// The pigment that has the colours of a map by a pattern that asks another pigment: a pigment_pattern, or a
// formula of one number of its colour, as pow(P(x,y,z).red, 2). It is the pattern of that pigment, with a map
// of both. None for other patterns, where a map has pigments, the pigment is no pattern of the Scene, or both
// are very long.
std::optional<Pigment> as_pattern_of_pigment(const Pattern& pattern, const std::vector<BlendEntry>& map);

}  // namespace vitrail::pov
