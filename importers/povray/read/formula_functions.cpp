// SPDX-License-Identifier: Apache-2.0
// Functions, and those of functions.inc, as steps of a formula.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "importers/povray/read/formula_maker.h"
#include "importers/povray/read/pattern_kinds.h"
#include "importers/povray/read/spline.h"
#include "importers/povray/read/transforms.h"

namespace vitrail::pov {

namespace {

using Op = PatternStep::Op;
using From = Instruction::Op;

std::optional<Op> op_of(From from) {
  switch (from) {
    case From::add:
      return Op::add;
    case From::subtract:
      return Op::subtract;
    case From::multiply:
      return Op::multiply;
    case From::divide:
      return Op::divide;
    case From::negate:
      return Op::negate;
    case From::invert:
      return Op::invert;
    case From::less:
      return Op::less;
    case From::greater:
      return Op::greater;
    case From::less_equal:
      return Op::less_equal;
    case From::greater_equal:
      return Op::greater_equal;
    case From::equal:
      return Op::equal;
    case From::unequal:
      return Op::unequal;
    case From::both:
      return Op::both;
    case From::either:
      return Op::either;
    default:
      return std::nullopt;
  }
}

struct NamedOp {
  Word word;
  Op op;
};
constexpr NamedOp named[] = {
    {Word::abs_, Op::absolute}, {Word::acos_, Op::acos},   {Word::acosh_, Op::acosh},
    {Word::asin_, Op::asin},    {Word::asinh_, Op::asinh}, {Word::atan_, Op::atan},
    {Word::atanh_, Op::atanh},  {Word::ceil_, Op::ceil},   {Word::cos_, Op::cos},
    {Word::cosh_, Op::cosh},    {Word::exp_, Op::exp},     {Word::floor_, Op::floor},
    {Word::int_, Op::trunc},    {Word::ln_, Op::ln},       {Word::sgn_, Op::sign},
    {Word::sin_, Op::sin},      {Word::sinh_, Op::sinh},   {Word::sqr_, Op::square},
    {Word::sqrt_, Op::sqrt},    {Word::tan_, Op::tan},     {Word::tanh_, Op::tanh},
    {Word::trunc_, Op::trunc},  {Word::atan2_, Op::atan2}, {Word::mod_, Op::modulo},
    {Word::pow_, Op::power},    {Word::max_, Op::max},     {Word::min_, Op::min},
};

// The functions of functions.inc, by their numbers there.
enum Internal {
  f_ellipsoid = 17,
  f_hetero_mf = 29,
  f_paraboloid = 45,
  f_ph = 47,
  f_r = 57,
  f_ridged_mf = 59,
  f_rounded_box = 60,
  f_sphere = 61,
  f_superellipsoid = 68,
  f_th = 69,
  f_torus = 70,
  f_noise3d = 76,
  f_noise_generator = 78,
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
          op(Op::multiply, 180 / std::numbers::pi);
        else if (word == Word::radians_)
          op(Op::multiply, std::numbers::pi / 180);
        else if (word == Word::log_)
          op(Op::ln), op(Op::multiply, 1 / std::numbers::ln10);
        else if (word == Word::div_)
          op(Op::divide), op(Op::trunc);
        else
          refuse();
        continue;
      }
      case From::choose:
        if (i.index == 3) pick(top_ - 1);
        op(Op::choose);
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
  pick(a), op(Op::add, -low), op(Op::multiply, 1 / (high - low)), op(Op::max, 0), op(Op::min, 1);
  op(Op::negate), op(Op::add, 1);
  constant(0);
  ask(std::move(part), first);
  keep_at(first);
}

void FormulaMaker::rounded_box(Slot a) {
  const Slot first = top_;
  for (Slot i = 0; i < 3; ++i) {
    pick_and(a + i, Op::absolute), pick(a + 4 + i), op(Op::subtract), pick(a + 3), op(Op::add);
    op(Op::max, 0);
  }
  lengths(std::array{first, first + 1, first + 2});
  pick(a + 3), op(Op::subtract);
  keep_at(first);
}

void FormulaMaker::superellipsoid(Slot a) {
  const auto power = [&](Slot x) {  // |x|^(2/e), n
    pick_and(x, Op::absolute), constant(2), pick(x == a + 2 ? a + 4 : a + 3), op(Op::divide), op(Op::power);
  };
  power(a), power(a + 1), op(Op::add);
  pick(a + 3), pick(a + 4), op(Op::divide), op(Op::power);
  power(a + 2), op(Op::add);
  pick(a + 4), op(Op::multiply, 0.5), op(Op::power);
  op(Op::negate), op(Op::add, 1);
}

void FormulaMaker::internal(int number, Slot a) {
  const Slot first = top_;
  switch (number) {
    case f_ellipsoid:
      for (Slot i = 0; i < 3; ++i) pick(a + i), pick(a + 3 + i), op(Op::multiply);
      lengths(std::array{first, first + 1, first + 2});
      return keep_at(first);
    case f_hetero_mf:
    case f_ridged_mf:
      for (Slot i = 0; i < 9; ++i) pick(a + i);
      return op(number == f_ridged_mf ? Op::ridged_mf : Op::hetero_mf);
    case f_paraboloid:
      pick(a + 1), pick_and(a, Op::square), pick_and(a + 2, Op::square), op(Op::add), op(Op::subtract);
      pick(a + 3), op(Op::multiply);
      return;
    case f_ph:
      lengths(std::array{a, a + 2});
      pick(a + 1), op(Op::atan2);
      return;
    case f_r:
      return lengths(std::array{a, a + 1, a + 2});
    case f_rounded_box:
      return rounded_box(a);
    case f_sphere:
      lengths(std::array{a, a + 1, a + 2});
      pick(a + 3), op(Op::subtract);
      return;
    case f_superellipsoid:
      return superellipsoid(a);
    case f_th:
      pick(a), pick(a + 2), op(Op::atan2);
      return;
    case f_torus:
      lengths(std::array{a, a + 2});
      pick(a + 3), op(Op::subtract);
      lengths(std::array{first, a + 1});
      pick(a + 4), op(Op::subtract);
      return keep_at(first);
    case f_noise3d:
    case f_noise_generator:
      for (Slot i = 0; i < 3; ++i) pick(a + i);
      return op(Op::noise);
    default:
      return refuse();
  }
}

}  // namespace vitrail::pov
