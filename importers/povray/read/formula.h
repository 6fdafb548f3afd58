// SPDX-License-Identifier: Apache-2.0
// The Scene has no kind for these patterns. They become its formulas (scene/records/pattern_formula.h).
#pragma once

#include <optional>

#include "importers/povray/read/surface.h"
#include "scene/records/pattern_texture.h"

namespace vitrail::pov {

// Returns the pattern in its own space, without a map and warps: of a kind of the Scene, or a formula.
// Returns none where no formula holds it: images, solids that are triangles, and very long ones.
std::optional<PatternTexture> pattern_record(const Pattern& pattern);

// Returns the pattern within a formula that has no turbulence, repetition and place yet: they are those of
// the formula, before the pattern's own.
PatternTexture carried(PatternTexture pattern);

// Returns whether the Scene has a kind for it, and needs no formula.
bool has_kind(const Pattern& pattern);

// Returns how many colours, textures or normals the kind takes in a list: of `object` two. 0: it has a map.
std::size_t places_of_list(Word kind);

// A formula has (place + ½)/places; the map of its numbers has the value of a place from here to the next.
inline double beginning_of_place(std::size_t place, std::size_t places) {
  return static_cast<double>(place) / static_cast<double>(places);
}

}  // namespace vitrail::pov
