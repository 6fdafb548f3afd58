// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/povray/read/value.h"

namespace vitrail::pov {

// Returns "1.5", "<1,2,3>", as #write writes them.
std::string text_of(const Numbers& numbers);

// Formats as POV-Ray's str(): at least `length` characters, filled with blanks, or zeros where `length` is
// negative; `digits` behind the point, six where it is negative.
std::string formatted(double value, int length, int digits);

}  // namespace vitrail::pov
