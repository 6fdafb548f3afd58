// SPDX-License-Identifier: Apache-2.0
// Each formula of functions.inc has a number, and the steps that put this number on the stack of a formula.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/records/pattern_formula.h"

namespace vitrail::pov {

// It is the code of an expression. Its arithmetic puts code together, so that one generic function gives a
// formula's number and its code.
class Steps {
 public:
  using Op = PatternStep::Op;

  Steps(double value) : code_{{Op::constant, 0, value}} {}  // a constant, as in 2 * x
  static Steps of_place(std::size_t place) {
    Steps steps(0);
    steps.code_.front() = {Op::pick, static_cast<std::uint32_t>(place), 0};
    return steps;
  }
  // Returns the code of an operation on some operands, the topmost last.
  static Steps of(Op op, const std::vector<Steps>& operands) {
    Steps all(0);
    all.code_.clear();
    for (const Steps& operand : operands)
      all.code_.insert(all.code_.end(), operand.code_.begin(), operand.code_.end());
    all.code_.push_back({op, 0, 0});
    return all;
  }
  const std::vector<PatternStep>& code() const { return code_; }

  friend Steps operator+(const Steps& a, const Steps& b) { return of(Op::add, {a, b}); }
  friend Steps operator-(const Steps& a, const Steps& b) { return of(Op::subtract, {a, b}); }
  friend Steps operator*(const Steps& a, const Steps& b) { return of(Op::multiply, {a, b}); }
  friend Steps operator/(const Steps& a, const Steps& b) { return of(Op::divide, {a, b}); }
  friend Steps operator-(const Steps& a) { return of(Op::negate, {a}); }

 private:
  std::vector<PatternStep> code_;
};

struct InternalFormula {
  int number;         // in functions.inc
  std::size_t count;  // of arguments: x, y, z, and then the parameters
  double (*value)(const double* arguments);
  Steps (*steps)(const Steps* arguments);
};

// Returns nullptr where none is known here.
const InternalFormula* internal_formula(int number);

}  // namespace vitrail::pov
