// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/povray/read/symbols.h"

namespace vitrail::pov {

// A function of one or two numbers, by the name that scenes and `function {}` know it by.
struct NumberFunction {
  Word word;
  double (*one)(double) = nullptr;
  double (*two)(double, double) = nullptr;
  bool folds = false;  // of more than two, by pairs: min, max
};

// nullptr: it is none. Angles in radians.
const NumberFunction* number_function(Word word);

// Whether an expression of numbers can begin with the word.
bool names_number(Word word);
// Whether one of text can.
bool names_text(Word word);

}  // namespace vitrail::pov
