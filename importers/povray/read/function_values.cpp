// SPDX-License-Identifier: Apache-2.0
// The stack machine that carries out functions.
#include <algorithm>
#include <array>
#include <cmath>

#include "importers/povray/read/function.h"
#include "importers/povray/read/pattern_field.h"
#include "importers/povray/read/spline.h"
#include "importers/povray/read/transforms.h"

namespace vitrail::pov {

namespace {

using Op = Instruction::Op;

bool looks_around(const Instruction& i) {
  return i.op == Op::argument || i.op == Op::call || i.op == Op::part;
}

}  // namespace

double component_of(const Numbers& n, std::uint8_t which) {
  if (which == grey_component) return 0.297 * n.v[0] + 0.589 * n.v[1] + 0.114 * n.v[2];
  // As povray shows it: 255/256 of a number of two bytes.
  if (which == height_component) return 0.996093 * (n.v[0] + n.v[1] / 255);
  return n.v[which];
}

std::optional<FormulaOfColor> formula_of_color(const Function& f) {
  const auto part = std::ranges::find(f.code, Op::part, &Instruction::op);
  if (part - f.code.begin() < 3 || part == f.code.end()) return std::nullopt;
  const Function& callee = *f.callees[part->index];
  if (!callee.source) return std::nullopt;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Instruction& argument = *(part - 3 + k);
    if (argument.op != Op::argument || argument.index != k) return std::nullopt;
  }
  if (std::ranges::count_if(f.code, looks_around) != 4) return std::nullopt;
  FormulaOfColor formula{callee.source, part->component, {}};
  formula.function.parameters.resize(1);
  formula.function.depth = f.depth;
  formula.function.code.assign(f.code.begin(), part - 2);  // with the first argument
  formula.function.code.insert(formula.function.code.end(), part + 1, f.code.end());
  return formula;
}

Numbers evaluate_vector(const Function& f, const double* a) {
  if (f.pigment) return f.pigment->color({a[0], a[1], a[2]});
  if (f.spline) return f.spline->at(a[0]);
  const Point3d p = transform_point(f.placement->transform, {a[0], a[1], a[2]});
  return Numbers::vector(p.x, p.y, p.z);
}

double evaluate(const Function& f, const double* arguments) {
  if (f.built_in) return f.built_in(arguments);
  if (f.pattern) return f.pattern->value({arguments[0], arguments[1], arguments[2]});
  if (f.gives_vector()) return component_of(evaluate_vector(f, arguments), f.pigment ? grey_component : 0);
  std::array<double, Function::most_operands + 2> stack;
  std::size_t top = 0;  // operands
  constexpr double tolerance = 1e-10;
  for (const Instruction& i : f.code) {
    double* const a = stack.data() + (top >= 2 ? top - 2 : 0);  // of two operands
    const double b = top > 0 ? stack[top - 1] : 0;
    switch (i.op) {
      case Op::constant:
        stack[top++] = i.value;
        continue;
      case Op::argument:
        stack[top++] = arguments[i.index];
        continue;
      case Op::one:
        stack[top - 1] = i.one(b);
        continue;
      case Op::negate:
        stack[top - 1] = -b;
        continue;
      case Op::invert:
        stack[top - 1] = b == 0;
        continue;
      case Op::choose: {
        const double* const s = stack.data() + (top - i.index);
        const double chosen = s[0] < 0 ? s[1] : s[0] == 0 || i.index == 3 ? s[2] : s[3];
        top -= i.index - 1;
        stack[top - 1] = chosen;
        continue;
      }
      case Op::call: {
        const Function& callee = *f.callees[i.index];
        const std::size_t count = callee.arguments();
        const double result = evaluate(callee, stack.data() + (top - count));
        top -= count;
        stack[top++] = result;
        continue;
      }
      case Op::part: {
        const Function& callee = *f.callees[i.index];
        top -= callee.arguments();
        stack[top] = component_of(evaluate_vector(callee, stack.data() + top), i.component);
        ++top;
        continue;
      }
      case Op::two:
        *a = i.two(*a, b);
        break;
      case Op::add:
        *a += b;
        break;
      case Op::subtract:
        *a -= b;
        break;
      case Op::multiply:
        *a *= b;
        break;
      case Op::divide:
        *a = b == 0 ? 0 : *a / b;
        break;
      case Op::less:
        *a = *a < b;
        break;
      case Op::greater:
        *a = *a > b;
        break;
      case Op::less_equal:
        *a = *a <= b + tolerance;
        break;
      case Op::greater_equal:
        *a = *a >= b - tolerance;
        break;
      case Op::equal:
        *a = std::abs(*a - b) < tolerance;
        break;
      case Op::unequal:
        *a = std::abs(*a - b) >= tolerance;
        break;
      case Op::both:
        *a = *a != 0 && b != 0;
        break;
      case Op::either:
        *a = *a != 0 || b != 0;
        break;
    }
    --top;
  }
  return stack[0];
}

}  // namespace vitrail::pov
