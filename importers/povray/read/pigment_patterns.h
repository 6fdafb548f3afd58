// SPDX-License-Identifier: Apache-2.0
// This file turns the colour of a pigment into the number of a pattern.
#pragma once

#include <optional>
#include <vector>

#include "importers/povray/read/surface.h"

namespace vitrail::pov {

// Weighs red, green and blue as povray does.
double grey_of(const Numbers& color);

// Returns the pigment that has the colours of a map by a pattern that asks another pigment. That is a
// pigment_pattern, or a formula of one number of its colour, as pow(P(x,y,z).red, 2). It is the pattern of
// that pigment, with a map of both. Returns none for other patterns, where a map has pigments, the pigment is
// no pattern of the Scene, or both are very long.
std::optional<Pigment> as_pattern_of_pigment(const Pattern& pattern, const std::vector<BlendEntry>& map);

}  // namespace vitrail::pov
