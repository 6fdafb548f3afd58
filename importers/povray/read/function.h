// SPDX-License-Identifier: Apache-2.0
// `function {}`: a formula of numbers, compiled to the code of a stack machine.
#pragma once

#include <span>
#include <vector>

#include "importers/povray/read/value.h"

namespace vitrail::pov {

class Reader;
struct Token;
struct Symbol;

struct Instruction {
  enum class Op : std::uint8_t {
    constant,
    argument,
    one,  // a function of the top
    two,  // of the two topmost
    add,
    subtract,
    multiply,
    divide,
    negate,
    invert,  // of truth
    less,
    greater,
    less_equal,
    greater_equal,
    equal,
    unequal,
    both,
    either,
    choose,  // select(): four operands
    call,    // another function, by `index`
  };
  Op op = Op::constant;
  std::uint32_t index = 0;  // of an argument or a function
  union {
    double value = 0;
    double (*one)(double);
    double (*two)(double, double);
  };
};

struct Function {
  std::vector<Symbol*> parameters;
  bool unnamed = false;  // x, y, z, as it gives none; u and v are then the first two
  std::vector<Instruction> code;
  std::vector<Shared<Function>> callees;
  double (*built_in)(const double* arguments) = nullptr;  // in place of code, of so many arguments
  std::size_t count = 3;
  bool unknown = false;         // a formula that is not known here: 0
  std::size_t depth = 0;        // of the stack
  Shared<Pigment> pigment;      // in place of code: a colour at a point
  Shared<Placement> placement;  // in place of code: a point moved
};

// The value for `count` arguments. Thread-safe; never throws.
double evaluate(const Function& function, const double* arguments);

// Behind the word `function`.
Shared<Function> read_function(Reader& reader);
// A call in an expression: a number, or a colour or a vector.
Value call_function(Reader& reader, const Function& function, const std::vector<double>& arguments,
                    const Token& name);

// A formula of functions.inc by its number there; nullptr: none of those that are known here.
Shared<Function> internal_function(int number);

}  // namespace vitrail::pov
