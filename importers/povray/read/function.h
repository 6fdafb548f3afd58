// SPDX-License-Identifier: Apache-2.0
// A `function {}` is a formula of numbers, compiled to the code of a stack machine.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "importers/povray/read/value.h"
#include "scene/system/diagnostics.h"

namespace vitrail::pov {

class PatternField;
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
    part,    // `component` of what another function gives, a colour or a vector
  };
  Op op = Op::constant;
  std::uint8_t component = 0;
  std::uint32_t index = 0;  // of an argument or a function; of `one` and `two` their Word
  union {
    double value = 0;
    double (*one)(double);
    double (*two)(double, double);
  };
};

struct Function {
  static constexpr std::size_t most_operands = 64;  // on the stack
  int levels = 1;
  std::vector<Symbol*> parameters;
  bool unnamed = false;  // x, y, z, as it gives none; u and v are then the first two
  std::vector<Instruction> code;
  std::vector<Shared<Function>> callees;
  double (*built_in)(const double* arguments) = nullptr;  // in place of code, of so many arguments
  std::size_t count = 3;
  int number = 0;         // of `built_in` in functions.inc
  bool unknown = false;   // a formula that is not known here: 0
  std::size_t depth = 0;  // of the stack
  // These stand in place of code:
  std::shared_ptr<const PatternField> pattern, pigment;  // a number or a colour at a point
  Shared<Pigment> source;                                // of `pattern` or `pigment`
  Shared<Placement> placement;                           // a point moved
  std::shared_ptr<const Spline> spline;

  Diagnostics notes;     // said where it is used: a file of functions has many that a scene never calls
  bool notable = false;  // it or one that it calls has notes

  bool gives_vector() const { return pigment || placement || spline; }
  std::size_t arguments() const { return built_in ? count : spline ? 1 : parameters.size(); }
};

// A colour has these components beside its five numbers: grey, and the height that red and green code.
inline constexpr std::uint8_t grey_component = 5, height_component = 6;

// Returns the value for `arguments()` numbers; of a colour its grey, of a vector the first. It is thread-safe
// and never throws.
double evaluate(const Function& function, const double* arguments);
// Evaluates a function that gives a vector.
Numbers evaluate_vector(const Function& function, const double* arguments);

// Returns the component by Instruction::component.
double component_of(const Numbers& color, std::uint8_t component);

// It is a function of x, y and z that uses them in one place alone: for one number of a pigment there.
struct FormulaOfColor {
  Shared<Pigment> pigment;
  std::uint8_t component = 0;
  Function function;  // of that number
};
std::optional<FormulaOfColor> formula_of_color(const Function& function);

// Reads behind the word `function`. Notes what the function and those that it calls approximate.
Shared<Function> read_function(Reader& reader);
// Reads the same. Its notes are given where it is used: by read_function of a caller, or by call_function.
Shared<Function> declare_function(Reader& reader);
// Evaluates a call in an expression: a number, or a colour or a vector.
Value call_function(Reader& reader, const Function& function, const std::vector<double>& arguments,
                    const Token& name);

// Returns a formula of functions.inc by its number there; nullptr where it is not known here.
Shared<Function> internal_function(int number);

}  // namespace vitrail::pov
