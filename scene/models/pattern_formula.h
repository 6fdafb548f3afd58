// SPDX-License-Identifier: Apache-2.0
// These patterns are formulas. They have the same bits on every machine.
#pragma once

#include "scene/records/pattern_texture.h"

namespace vitrail {

// Returns the number that the steps leave, before frequency, phase and wave; 0 where that is not finite. `p`
// is in the pattern's space, after turbulence; `n` is the unit normal towards the ray, in the world. The
// formula has no fault.
double formula_value(const PatternTexture& formula, Point3d p, Vector3d n);

// Returns null where the formula is sound: its stack is never empty nor too deep, its indices are those of
// what is there, and its cost is bounded. Else it returns what is wrong, for a message: "has …".
const char* fault_of_formula(const PatternTexture& formula);

// Returns how many numbers a step takes from the stack.
std::size_t operands_of(PatternStep::Op op);

// Returns the number of p = x + iy (pattern_fractal.cpp).
double fractal_value(const PatternFractal& fractal, double x, double y);

}  // namespace vitrail
