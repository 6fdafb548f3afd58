// SPDX-License-Identifier: Apache-2.0
#include "scene/models/pattern_formula.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "scene/geometry/portable_math.h"
#include "scene/models/pattern.h"
#include "scene/models/pattern_noise.h"

namespace vitrail {

namespace {

using Op = PatternStep::Op;
using Kind = PatternTexture::Kind;

constexpr std::uint64_t cost_of_pattern = 64, cost_of_octaves = 32, most_cost = 1 << 16;

double sinh_of(double x) { return 0.5 * (portable_exp(x) - portable_exp(-x)); }
double cosh_of(double x) { return 0.5 * (portable_exp(x) + portable_exp(-x)); }
double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

double of_one(Op op, double a) {
  switch (op) {
    case Op::negate:
      return -a;
    case Op::invert:
      return a == 0;
    case Op::absolute:
      return std::abs(a);
    case Op::acos:
      return portable_acos(a);
    case Op::acosh:
      return portable_log(a + std::sqrt(a * a - 1));
    case Op::asin:
      return pi / 2 - portable_acos(a);
    case Op::asinh:
      return sign_of(a) * portable_log(std::abs(a) + std::sqrt(a * a + 1));
    case Op::atan:
      return portable_atan2(a, 1);
    case Op::atanh:
      return 0.5 * portable_log((1 + a) / (1 - a));
    case Op::ceil:
      return std::ceil(a);
    case Op::cos:
      return portable_cos(a);
    case Op::cosh:
      return cosh_of(a);
    case Op::exp:
      return portable_exp(a);
    case Op::floor:
      return std::floor(a);
    case Op::ln:
      return portable_log(a);
    case Op::sign:
      return sign_of(a);
    case Op::sin:
      return portable_sin(a);
    case Op::sinh:
      return sinh_of(a);
    case Op::square:
      return a * a;
    case Op::sqrt:
      return safe_sqrt(a);
    case Op::tan:
      return portable_tan(a);
    case Op::tanh: {
      constexpr double one = 20;  // from here on
      return std::abs(a) > one ? sign_of(a) : sinh_of(a) / cosh_of(a);
    }
    default:
      return std::trunc(a);
  }
}

// Negative numbers have powers that are whole.
double power(double a, double b) {
  if (a >= 0) return portable_pow(a, b);
  if (b != std::floor(b)) return 0;
  const double size = portable_pow(-a, b);
  return b / 2 == std::floor(b / 2) ? size : -size;
}

double of_two(Op op, double a, double b) {
  constexpr double tolerance = 1e-10;  // as povray's
  switch (op) {
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return b == 0 ? 0 : a / b;
    case Op::less:
      return a < b;
    case Op::greater:
      return a > b;
    case Op::less_equal:
      return a <= b + tolerance;
    case Op::greater_equal:
      return a >= b - tolerance;
    case Op::equal:
      return std::abs(a - b) < tolerance;
    case Op::unequal:
      return std::abs(a - b) >= tolerance;
    case Op::both:
      return a != 0 && b != 0;
    case Op::either:
      return a != 0 || b != 0;
    case Op::atan2:
      return portable_atan2(a, b);
    case Op::modulo:
      return b == 0 ? 0 : std::fmod(a, b);
    case Op::power:
      return power(a, b);
    case Op::max:
      return std::max(a, b);
    default:
      return std::min(a, b);
  }
}

double constant_of(const PatternStop& stop) {
  return static_cast<double>(std::get<ConstantSpectrum>(std::get<Spectrum>(stop.value)).value);
}
bool is_number(const PatternStop& stop) {
  const auto* spectrum = std::get_if<Spectrum>(&stop.value);
  return spectrum && std::holds_alternative<ConstantSpectrum>(*spectrum);
}

double at_point(const PatternTexture& t, const double* a) {
  constexpr double far = 0x1p50;
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(a[i]) < far)) return 0;
  const Point3d p{a[0], a[1], a[2]};
  if (t.map.empty()) return pattern_value(t, p);
  const PatternMix mix = pattern_mix(t, p);
  return (1 - mix.amount) * constant_of(t.map[mix.first]) + mix.amount * constant_of(t.map[mix.second]);
}

}  // namespace

std::size_t operands_of(Op op) {
  if (op == Op::constant || op == Op::pick) return 0;
  if (op <= Op::trunc) return 1;  // of `slide`, that which stays
  if (op <= Op::min || op == Op::fractal) return 2;
  if (op == Op::pattern) return 3;
  return op == Op::choose || op == Op::noise ? 4 : 9;
}

double formula_value(const PatternTexture& t, Point3d p, Vector3d n) {
  std::array<double, most_formula_operands> stack{p.x, p.y, p.z, n.x, n.y, n.z};
  std::size_t top = formula_inputs;
  for (const PatternStep& step : t.steps) {
    const std::size_t count = operands_of(step.op);
    top -= count;
    double* const a = stack.data() + top++;
    switch (step.op) {
      case Op::constant:
        *a = step.value;
        break;
      case Op::pick:
        *a = stack[step.index];
        break;
      case Op::slide:
        top -= step.index;
        stack[top - 1] = *a;
        break;
      case Op::choose:
        *a = a[0] < 0 ? a[1] : a[0] == 0 ? a[2] : a[3];
        break;
      case Op::noise:
        *a = pattern_noise({a[0], a[1], a[2]}, noise_generator(a[3]));
        break;
      case Op::ridged_mf:
        *a = ridged_multifractal(a);
        break;
      case Op::hetero_mf:
        *a = hetero_multifractal(a);
        break;
      case Op::pattern:
        *a = at_point(t.patterns[step.index], a);
        break;
      case Op::fractal:
        *a = fractal_value(t.fractals[step.index], a[0], a[1]);
        break;
      default:
        *a = count == 1 ? of_one(step.op, *a) : of_two(step.op, a[0], a[1]);
    }
  }
  const double value = stack[top - 1];
  return std::isfinite(value) ? value : 0;
}

const char* fault_of_formula(const PatternTexture& t) {
  constexpr std::uint32_t most_exponent = 33, most_iterations = 10000;
  if (t.steps.empty() || t.steps.size() > most_formula_steps) return "has an impossible number of steps";
  for (const PatternFractal& f : t.fractals)
    if (f.exponent < 2 || f.exponent > most_exponent || f.iterations < 1 || f.iterations > most_iterations)
      return "has a fractal that makes no sense";
  for (const PatternTexture& part : t.patterns) {
    if (part.kind == Kind::formula) return "has a formula in its formula";
    if (!std::ranges::all_of(part.map, is_number)) return "has a map in its formula that is not of numbers";
    if (const char* fault = fault_of(part)) return fault;
  }
  std::size_t depth = formula_inputs;
  std::uint64_t cost = 0;
  for (const PatternStep& step : t.steps) {
    const std::size_t operands = operands_of(step.op);
    if (depth < operands) return "takes more from its stack than it has";
    if (step.op == Op::pick && step.index >= depth) return "looks beyond its stack";
    if (step.op == Op::slide && step.index >= depth) return "takes more from its stack than it has";
    if (step.op == Op::pattern && step.index >= t.patterns.size()) return "has a step without its pattern";
    if (step.op == Op::fractal && step.index >= t.fractals.size()) return "has a step without its fractal";
    depth += 1 - operands;
    if (step.op == Op::slide) depth -= step.index;
    if (depth > most_formula_operands) return "has a stack that is too deep";
    cost += step.op == Op::pattern                                 ? cost_of_pattern
            : step.op == Op::fractal                               ? t.fractals[step.index].iterations
            : step.op == Op::ridged_mf || step.op == Op::hetero_mf ? cost_of_octaves
                                                                   : 1;
    if (cost > most_cost) return "has a formula that takes too long";
  }
  return nullptr;
}

}  // namespace vitrail
