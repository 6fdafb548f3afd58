// SPDX-License-Identifier: Apache-2.0
// These functions return what POV-Ray's patterns have at a point, to the last digit of its pictures, and the
// same bits on every machine.
#pragma once

#include <cstddef>

#include "scene/records/pattern_texture.h"

namespace vitrail {

// It mixes two values of the map, by their places: (1 − amount)·first + amount·second. The map is not empty.
struct PatternMix {
  std::size_t first = 0, second = 0;
  double amount = 0;  // 0 … 1
};

// Returns the mix at `p`, which is in the pattern's space, before tiles and turbulence. `n` is the unit
// normal towards the ray, in the world, which formulas alone look at.
PatternMix pattern_mix(const PatternTexture& pattern, Point3d p, Vector3d n = {});
// Returns the pattern's number, 0 … 1, by the wave. For kinds by places it is the place over the greatest one
// of the kind.
double pattern_value(const PatternTexture& pattern, Point3d p, Vector3d n = {});

// Returns why the pattern makes no sense, for a message: "has …"; null where it is sound.
const char* fault_of(const PatternTexture& pattern);

}  // namespace vitrail
