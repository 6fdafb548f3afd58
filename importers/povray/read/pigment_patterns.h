// SPDX-License-Identifier: Apache-2.0
// `pigment_pattern`: the grey of a pigment as the number of a pattern.
#pragma once

#include <optional>
#include <vector>

#include "importers/povray/read/surface.h"

namespace vitrail::pov {

// As povray weighs red, green and blue.
double grey_of(const Numbers& color);

// The pigment that has the colours of a map at the greys of `inner`: its pattern, with a map of both. None
// where one of them has pigments in its map, or `inner` is no pattern of the Scene.
std::optional<Pigment> colored_by_grey(const Pigment& inner, const std::vector<BlendEntry>& map);

}  // namespace vitrail::pov
