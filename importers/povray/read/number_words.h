// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/povray/read/symbols.h"

namespace vitrail::pov {

// It is a function of one or two numbers, by the name that scenes and `function {}` know it by.
struct NumberFunction {
  Word word;
  double (*one)(double) = nullptr;
  double (*two)(double, double) = nullptr;
  bool folds = false;  // of more than two, by pairs: min, max
};

// Returns nullptr where it is none. Angles are in radians.
const NumberFunction* number_function(Word word);

// Returns whether an expression of numbers can begin with the word.
bool names_number(Word word);
// Returns whether an expression of text can.
bool names_text(Word word);

}  // namespace vitrail::pov
