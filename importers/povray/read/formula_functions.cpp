// SPDX-License-Identifier: Apache-2.0
// Functions, and those of functions.inc, as steps of a formula.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "importers/povray/read/formula_maker.h"
#include "importers/povray/read/internal_functions.h"
#include "importers/povray/read/pattern_kinds.h"
#include "importers/povray/read/spline.h"
#include "importers/povray/read/transforms.h"

namespace vitrail::pov {

namespace {

using StepOp = PatternStep::Op;
using From = Instruction::Op;

std::optional<StepOp> op_of(From from) {
  switch (from) {
    case From::add:
      return StepOp::add;
    case From::subtract:
      return StepOp::subtract;
    case From::multiply:
      return StepOp::multiply;
    case From::divide:
      return StepOp::divide;
    case From::negate:
      return StepOp::negate;
    case From::invert:
      return StepOp::invert;
    case From::less:
      return StepOp::less;
    case From::greater:
      return StepOp::greater;
    case From::less_equal:
      return StepOp::less_equal;
    case From::greater_equal:
      return StepOp::greater_equal;
    case From::equal:
      return StepOp::equal;
    case From::unequal:
      return StepOp::unequal;
    case From::both:
      return StepOp::both;
    case From::either:
      return StepOp::either;
    default:
      return std::nullopt;
  }
}

struct NamedOp {
  Word word;
  StepOp op;
};
constexpr NamedOp named[] = {
    {Word::abs_, StepOp::absolute}, {Word::acos_, StepOp::acos},   {Word::acosh_, StepOp::acosh},
    {Word::asin_, StepOp::asin},    {Word::asinh_, StepOp::asinh}, {Word::atan_, StepOp::atan},
    {Word::atanh_, StepOp::atanh},  {Word::ceil_, StepOp::ceil},   {Word::cos_, StepOp::cos},
    {Word::cosh_, StepOp::cosh},    {Word::exp_, StepOp::exp},     {Word::floor_, StepOp::floor},
    {Word::int_, StepOp::trunc},    {Word::ln_, StepOp::ln},       {Word::sgn_, StepOp::sign},
    {Word::sin_, StepOp::sin},      {Word::sinh_, StepOp::sinh},   {Word::sqr_, StepOp::square},
    {Word::sqrt_, StepOp::sqrt},    {Word::tan_, StepOp::tan},     {Word::tanh_, StepOp::tanh},
    {Word::trunc_, StepOp::trunc},  {Word::atan2_, StepOp::atan2}, {Word::mod_, StepOp::modulo},
    {Word::pow_, StepOp::power},    {Word::max_, StepOp::max},     {Word::min_, StepOp::min},
};

}  // namespace

void FormulaMaker::component(const Function& f, std::uint8_t which, Slot a) {
  if (f.pigment) return pigment(*f.source, which, a);
  if (f.spline) return spline(*f.spline, which, a);
  if (which > 2) return constant(0);
  row(f.placement->transform, which, a);
}

void FormulaMaker::function(const Function& f, Slot a) {
  if (!held_) return;
  if (f.unknown) return refuse();
  if (f.built_in) return internal(f.number, a);
  if (f.gives_vector()) return component(f, f.pigment ? grey_component : 0, a);
  if (!f.pattern) return code(f, a);
  // The number of the pattern alone: of a list the place.
  Pigment grey = *f.source;
  BlendMap map;
  const auto kind = pattern_kind(grey.pattern.kind);
  const bool list = kind && is_of_places(*kind);
  for (int i = 0; i < (list ? 3 : 2); ++i) {
    BlendEntry entry;
    entry.at = i, entry.color = Finish::grey(i);
    map.entries.push_back(entry);
  }
  grey.color.reset();
  grey.map = std::make_shared<BlendMap>(std::move(map));
  pigment(grey, grey_component, a);
}

void FormulaMaker::code(const Function& f, Slot a) {
  const Slot first = top_;
  for (const Instruction& i : f.code) {
    if (!held_) return;
    switch (i.op) {
      case From::constant:
        constant(i.value);
        continue;
      case From::argument:
        pick(a + i.index);
        continue;
      case From::one:
      case From::two: {
        const Word word{static_cast<std::uint16_t>(i.index)};
        const auto* found = std::ranges::find(named, word, &NamedOp::word);
        if (found != std::end(named))
          op(found->op);
        else if (word == Word::degrees_)
          op(StepOp::multiply, 180 / std::numbers::pi);
        else if (word == Word::radians_)
          op(StepOp::multiply, std::numbers::pi / 180);
        else if (word == Word::log_)
          op(StepOp::ln), op(StepOp::multiply, 1 / std::numbers::ln10);
        else if (word == Word::div_)
          op(StepOp::divide), op(StepOp::trunc);
        else
          refuse();
        continue;
      }
      case From::choose:
        if (i.index == 3) pick(top_ - 1);
        op(StepOp::choose);
        continue;
      case From::call:
      case From::part: {
        const Function& callee = *f.callees[i.index];
        const Slot arguments = top_ - callee.arguments();
        if (i.op == From::part)
          component(callee, i.component, arguments);
        else
          function(callee, arguments);
        if (callee.arguments() > 0) keep_at(arguments);
        continue;
      }
      default:
        op(*op_of(i.op));
    }
  }
  if (held_ && top_ != first + 1) refuse();
}

// Of so many straight pieces between two knots where it is curved.
void FormulaMaker::spline(const Spline& s, std::uint8_t which, Slot a) {
  constexpr int pieces = 64;
  constexpr std::size_t most = 4096;
  if (s.knots.size() < 2 || s.knots.size() * pieces > most || which > 4) return refuse();
  const double low = s.knots.front().at, high = s.knots.back().at;
  if (!(high > low)) return refuse();
  PatternTexture part;
  part.kind = PatternTexture::Kind::planar;
  const auto add = [&](double at) {
    part.map.push_back({static_cast<float>((at - low) / (high - low)),
                        Spectrum{ConstantSpectrum{static_cast<float>(s.at(at).v[which])}}});
  };
  for (std::size_t i = 0; i + 1 < s.knots.size(); ++i) {
    const double from = s.knots[i].at, to = s.knots[i + 1].at;
    const int count = s.kind == Spline::Kind::linear ? 1 : pieces;
    for (int k = 0; k < count; ++k) add(from + (to - from) * k / count);
  }
  add(high);
  std::ranges::stable_sort(part.map, {}, &PatternStop::at);
  const Slot first = top_;
  constant(0);
  pick(a), op(StepOp::add, -low), op(StepOp::multiply, 1 / (high - low)), op(StepOp::max, 0),
      op(StepOp::min, 1);
  op(StepOp::negate), op(StepOp::add, 1);
  constant(0);
  ask(std::move(part), first);
  keep_at(first);
}

void FormulaMaker::internal(int number, Slot a) {
  const InternalFormula* formula = internal_formula(number);
  if (!formula) return refuse();
  std::vector<Steps> arguments;
  for (Slot i = 0; i < formula->count; ++i) arguments.push_back(Steps::of_place(a + i));
  const Steps steps = formula->steps(arguments.data());
  for (const PatternStep& step : steps.code()) emit(step.op, step.index, step.value);
}

}  // namespace vitrail::pov
