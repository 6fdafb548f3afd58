// SPDX-License-Identifier: Apache-2.0
// Patterns that are formulas. The same bits on every machine.
#pragma once

#include "scene/records/pattern_texture.h"

namespace vitrail {

// What the steps leave, before frequency, phase and wave; 0 where that is not finite. `p`: of the pattern's
// space, after turbulence. `n`: the unit normal towards the ray, in the world. The formula has no fault.
double formula_value(const PatternTexture& formula, Point3d p, Vector3d n);

// Null: its stack is never empty nor too deep, its indices are those of what is there, and its cost is
// bounded. Else what is wrong, for a message: "has …".
const char* fault_of_formula(const PatternTexture& formula);

// How many numbers a step takes from the stack.
std::size_t operands_of(PatternStep::Op op);

// The number of p = x + iy (pattern_fractal.cpp).
double fractal_value(const PatternFractal& fractal, double x, double y);

}  // namespace vitrail
