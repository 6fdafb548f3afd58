// SPDX-License-Identifier: Apache-2.0
// It compiles functions, pigments and solids to the steps of a formula. Calls are put in place: the stack is
// as deep at each step whatever its numbers are, and a place in it is known here.
#pragma once

#include <span>

#include "importers/povray/read/function.h"
#include "importers/povray/read/object.h"
#include "scene/records/pattern_texture.h"

namespace vitrail::pov {

class FormulaMaker {
 public:
  using Op = PatternStep::Op;
  using Slot = std::size_t;  // a place in the stack; of a point the first of three

  explicit FormulaMaker(PatternTexture& formula) : t_(formula) {}

  // Returns false where something cannot be held; the formula is then of no use.
  bool is_held() const { return held_; }
  void refuse() { held_ = false; }

  // Each puts one number on the stack. For a pattern it is that before its frequency, phase and wave; for a
  // list, the place.
  void pattern(const Pattern& pattern, Slot point);
  void pigment(const Pigment& pigment, std::uint8_t component, Slot point);
  void function(const Function& function, Slot arguments);
  void object(const Object& object, Slot point);  // 1 inside
  void carry(PatternTexture part) { ask(std::move(part), 0); }

  void constant(double value) { emit(Op::constant, 0, value); }
  void pick(Slot slot) { emit(Op::pick, slot); }
  void op(Op op) { emit(op); }
  // Emits an operation with a number.
  void op(Op with, double value) { constant(value), op(with); }
  void pick_and(Slot slot, Op with) { pick(slot), op(with); }
  Slot top() const { return top_; }
  // Moves the topmost number down to that place, and drops those between.
  void keep_at(Slot slot);

 private:
  void emit(Op op, std::size_t index = 0, double value = 0);
  void code(const Function& function, Slot arguments);
  void component(const Function& function, std::uint8_t component, Slot arguments);
  void internal(int number, Slot arguments);  // formula_functions.cpp
  void spline(const Spline& spline, std::uint8_t component, Slot argument);
  void lengths(std::span<const Slot> slots);
  void slope(const Pattern& pattern, Slot point);
  void spiral2(const Pattern& pattern, Slot point);
  void cubic(Slot point);
  void square(Slot point);
  void triangular(Slot point);
  void fractal(const Pattern& pattern, Slot point);
  // Blends a map's entries by what `part` has at the three numbers from `number` on; `places` is a list's.
  void blend(PatternTexture part, const std::vector<BlendEntry>& entries, std::uint8_t component,
             std::size_t places, Slot number, Slot point);
  void average(const std::vector<BlendEntry>& entries, std::uint8_t component, Slot point);
  void entry(const BlendEntry& entry, std::uint8_t component, Slot point);
  // Puts on the stack the three numbers that the part is asked at.
  PatternTexture part_of(const Pattern& pattern, Slot point);
  void ask(PatternTexture part, Slot point);
  void row(const Transform& m, std::size_t row, Slot point);
  Slot moved(const Transform& m, Slot point);  // three numbers
  void shape(const Object& object, Slot point);
  void group(const Object& object, Slot point);
  void dot_with(Vector3d v, Slot point);

  PatternTexture& t_;
  Slot top_ = formula_inputs;
  bool held_ = true;
};

}  // namespace vitrail::pov
