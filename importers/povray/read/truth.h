// SPDX-License-Identifier: Apache-2.0
// Conditions take numbers for true and for equal within a tolerance, as measured with povray 3.7.
#pragma once

#include <cmath>

namespace vitrail::pov {

// It is for =, !=, <= and >=. < and > compare without tolerance: a loop `while (I < 1)` in steps of .1, whose
// sum is 1 − 10⁻¹⁶, goes round eleven times.
inline bool are_equal(double a, double b) { return std::abs(a - b) < 1e-10; }
inline bool is_true(double number) { return std::abs(number) > 1e-10; }

}  // namespace vitrail::pov
