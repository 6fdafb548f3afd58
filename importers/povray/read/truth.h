// SPDX-License-Identifier: Apache-2.0
// What conditions hold for true and for equal; measured with povray 3.7.
#pragma once

#include <cmath>

namespace vitrail::pov {

// Of =, !=, <= and >=. For < and > equal numbers are the same: a loop `while (I < 1)` in steps of .1, whose
// sum is 1 − 10⁻¹⁶, goes round eleven times.
inline bool are_equal(double a, double b) { return std::abs(a - b) < 1e-10; }
inline bool is_true(double number) { return std::abs(number) > 1e-10; }

}  // namespace vitrail::pov
