// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/formula_maker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "importers/povray/read/formula.h"
#include "importers/povray/read/pattern_kinds.h"
#include "scene/geometry/pi.h"
#include "scene/models/pattern.h"
#include "scene/models/pattern_formula.h"

namespace vitrail::pov {

void FormulaMaker::emit(Op op, std::size_t index, double value) {
  const std::size_t operands = operands_of(op);
  if (!std::isfinite(value) || t_.steps.size() >= most_formula_steps ||
      top_ + 1 - operands > most_formula_operands)
    held_ = false;
  if (!held_) return;
  t_.steps.push_back({op, static_cast<std::uint32_t>(index), value});
  top_ += 1 - operands;
  if (op == Op::slide) top_ -= index;
}

void FormulaMaker::keep_at(Slot slot) {
  if (held_ && top_ - 1 > slot) emit(Op::slide, top_ - 1 - slot);
}

void FormulaMaker::dot_with(Vector3d v, Slot p) {
  constant(0);
  for (int axis = 0; axis < 3; ++axis) {
    if (v[axis] == 0) continue;
    pick(p + static_cast<Slot>(axis));
    if (v[axis] != 1) op(Op::multiply, v[axis]);
    op(Op::add);
  }
}

void FormulaMaker::row(const Transform& m, std::size_t row, Slot p) {
  dot_with({m.m[row][0], m.m[row][1], m.m[row][2]}, p);
  if (m.m[row][3] != 0) op(Op::add, m.m[row][3]);
}

FormulaMaker::Slot FormulaMaker::moved(const Transform& m, Slot p) {
  const Slot first = top_;
  for (std::size_t i = 0; i < 3; ++i) row(m, i, p);
  return first;
}

void FormulaMaker::lengths(std::span<const Slot> slots) {
  constant(0);
  for (const Slot slot : slots) pick_and(slot, Op::square), op(Op::add);
  op(Op::sqrt);
}

void FormulaMaker::ask(PatternTexture part, Slot p) {
  for (Slot i = 0; i < 3; ++i) pick(p + i);
  t_.patterns.push_back(std::move(part));
  emit(Op::pattern, t_.patterns.size() - 1);
}

// 1 − acos(n·d)/π, stretched; with an altitude the mean of both, by the lengths of their directions. povray
// turns that of the slope by no transform.
void FormulaMaker::slope(const Pattern& pattern, Slot p) {
  constexpr Slot normal = 3;
  const Pattern::Slope& s = pattern.slope;
  if (!(length(s.direction) > 0) || s.low == s.high || s.low_altitude == s.high_altitude) return refuse();
  dot_with(normalize(s.direction), normal);
  op(Op::acos);
  op(Op::multiply, -1 / pi);
  op(Op::add, 1 - s.low);
  op(Op::multiply, 1 / (s.high - s.low));
  if (!(length(s.altitude) > 0)) return;
  const double share = length(s.altitude) / (length(s.direction) + length(s.altitude));
  op(Op::multiply, 1 - share);
  dot_with(normalize(s.altitude), p);
  op(Op::add, -s.low_altitude);
  op(Op::multiply, share / (s.high_altitude - s.low_altitude));
  op(Op::add);
}

// Δ(r) + Δ(r + z + arms·turn), with Δ the triangle wave.
void FormulaMaker::spiral2(const Pattern& pattern, Slot p) {
  const auto triangle = [&](Slot of) {  // 1 − |2t − 1|, t what is beyond whole numbers
    pick(of), pick_and(of, Op::floor), op(Op::subtract);
    op(Op::multiply, 2), op(Op::subtract, 1);
    op(Op::absolute), op(Op::negate), op(Op::add, 1);
  };
  const Slot r = top_;
  lengths(std::array{p, p + 1});
  const Slot turns = top_;
  pick(p + 1), pick(p), op(Op::atan2);
  op(Op::multiply, pattern.arms / (2 * pi)), op(Op::add, 0.25 * pattern.arms);
  pick(r), op(Op::add), pick(p + 2), op(Op::add);
  triangle(r), triangle(turns), op(Op::add);
  keep_at(r);
}

// The side that the point is nearest to: +x +y +z −x −y −z.
void FormulaMaker::cubic(Slot p) {
  const Slot first = top_;
  for (Slot i = 0; i < 3; ++i) pick_and(p + i, Op::absolute);
  pick(first), pick(first + 1), op(Op::greater_equal);
  pick(first), pick(first + 2), op(Op::greater_equal), op(Op::both);  // whether x
  pick(first + 1), pick(first + 2), op(Op::greater_equal);            // whether y before z
  const Slot is_x = first + 3, is_y = first + 4;
  // axis = x ? 0 : y ? 1 : 2, and the coordinate along it
  const auto chosen = [&](auto&& x, auto&& y, auto&& z) {
    pick_and(is_x, Op::invert), op(Op::negate);
    pick_and(is_y, Op::invert), op(Op::negate), z(), y(), y(), op(Op::choose), x(), x(), op(Op::choose);
  };
  const auto number = [&](double value) { return [this, value] { constant(value); }; };
  const auto coordinate = [&](Slot slot) { return [this, slot] { pick(slot); }; };
  chosen(number(0), number(1), number(2));
  chosen(coordinate(p), coordinate(p + 1), coordinate(p + 2));
  constant(0), op(Op::less), op(Op::multiply, 3), op(Op::add);
  keep_at(first);
}

// Of unit squares in x and z, around each corner: the first has (0,0), the second is beyond it along z.
void FormulaMaker::square(Slot p) {
  const auto odd = [&](Slot slot) {
    pick_and(slot, Op::floor), op(Op::multiply, 0.5);
    pick(top_ - 1), op(Op::floor), op(Op::subtract), op(Op::multiply, 2);
  };
  const Slot first = top_;
  odd(p), odd(p + 2);
  pick(first), op(Op::multiply, 3);
  pick(first), pick(first + 1), op(Op::multiply), op(Op::multiply, -2), op(Op::add);
  pick(first + 1), op(Op::add);
  keep_at(first);
}

// Of triangles of side 1 in −x and z. In the cell (i, j) of the lattice of (1, 0) and (½, √¾), with d = i − j
// modulo 3, the one at the cell's corner has the place 2 + 2d modulo 6 and the one beyond it 5 − 2d.
void FormulaMaker::triangular(Slot p) {
  const Slot v = top_, u = v + 1, i = v + 2, j = v + 3, d = v + 4, is_beyond = v + 5, corner = v + 6;
  pick(p + 2), op(Op::multiply, 2 / std::sqrt(3.0));
  pick(v), op(Op::multiply, -0.5), pick(p), op(Op::subtract);
  pick_and(u, Op::floor), pick_and(v, Op::floor);
  pick(i), pick(j), op(Op::subtract), op(Op::multiply, 1.0 / 3);
  pick(top_ - 1), op(Op::floor), op(Op::subtract), op(Op::multiply, 3);
  constant(1), pick(u), pick(v), op(Op::add), pick(i), op(Op::subtract), pick(j), op(Op::subtract);
  op(Op::less);
  pick(d), op(Op::multiply, 2), op(Op::add, 2);
  constant(1.5), pick(d), op(Op::less), op(Op::multiply, 6), op(Op::subtract);
  constant(5), pick(d), op(Op::multiply, 2), op(Op::subtract), pick(corner), op(Op::subtract);
  pick(is_beyond), op(Op::multiply), pick(corner), op(Op::add);
  keep_at(v);
}

void FormulaMaker::fractal(const Pattern& pattern, Slot p) {
  pick(p), pick(p + 1);
  PatternFractal f = pattern.fractal;
  constexpr int most = 10000;
  f.iterations = static_cast<std::uint32_t>(std::clamp(pattern.iterations, 1, most));
  t_.fractals.push_back(f);
  emit(Op::fractal, t_.fractals.size() - 1);
}

void FormulaMaker::pattern(const Pattern& pattern, Slot p) {
  if (!held_) return;
  switch (pattern.kind) {
    case Word::function_:
      if (!pattern.function || pattern.function->arguments() > 3) return refuse();
      return function(*pattern.function, p);
    case Word::object_:
      return pattern.object ? object(*pattern.object, p) : refuse();
    case Word::pigment_pattern_:
      return pattern.pigment ? pigment(*pattern.pigment, grey_component, p) : refuse();
    case Word::slope_:
      return slope(pattern, p);
    case Word::spiral2_:
      return spiral2(pattern, p);
    case Word::cubic_:
      return cubic(p);
    case Word::square_:
      return square(p);
    case Word::triangular_:
      return triangular(p);
    case Word::mandel_:
    case Word::julia_:
    case Word::magnet_:
      return fractal(pattern, p);
    default:
      return refuse();
  }
}

// Puts what the part needs on the stack: a point, or the place where `planar` has the number.
PatternTexture FormulaMaker::part_of(const Pattern& given, Slot p) {
  PatternTexture part = record_of(given);
  if (has_kind(given)) {
    for (Slot i = 0; i < 3; ++i) pick(p + i);
    return part;
  }
  if (part.turbulence.amount != Vector3d{}) refuse();
  part.kind = PatternTexture::Kind::planar;
  const Slot first = top_;
  constant(0);
  pattern(given, p);
  if (const std::size_t places = places_of_list(given.kind))
    op(Op::add, 0.5), op(Op::multiply, 1 / static_cast<double>(places));
  // What is between 0 and 1, as povray has it.
  const Slot value = first + 1;
  pick(value), pick_and(value, Op::floor), op(Op::subtract);
  pick(value), op(Op::equal, 1), op(Op::add), keep_at(value);
  op(Op::negate), op(Op::add, 1);
  constant(0);
  return part;
}

void FormulaMaker::entry(const BlendEntry& entry, std::uint8_t component, Slot p) {
  if (entry.pigment) return pigment(*entry.pigment, component, p);
  constant(component_of(entry.color, component));
}

void FormulaMaker::average(const std::vector<BlendEntry>& entries, std::uint8_t component, Slot p) {
  double weights = 0;
  for (const BlendEntry& e : entries) weights += e.at;
  if (!(weights > 0)) return refuse();
  constant(0);
  for (const BlendEntry& e : entries) entry(e, component, p), op(Op::multiply, e.at / weights), op(Op::add);
}

void FormulaMaker::blend(PatternTexture part, const std::vector<BlendEntry>& entries, std::uint8_t component,
                         std::size_t places, Slot number, Slot p) {
  const std::size_t count = entries.size();
  const bool of_places = is_of_places(part.kind);
  const auto stops = [&](auto&& value) {
    PatternTexture asked = part;
    const auto add = [&](double at, std::size_t i) {
      asked.map.push_back({static_cast<float>(std::clamp(at, 0.0, 1.0)),
                           Spectrum{ConstantSpectrum{static_cast<float>(value(i))}}});
    };
    for (std::size_t i = 0; i < std::max(places, count); ++i)
      if (of_places && i < count)
        add(0, i);
      else if (places > 0 && i < places)
        add(beginning_of_place(i, places), std::min(i, count - 1)),
            add(beginning_of_place(i + 1, places), std::min(i, count - 1));
      else if (places == 0)
        add(entries[i].at, i);
    std::ranges::stable_sort(asked.map, {}, &PatternStop::at);
    return asked;
  };
  if (std::ranges::none_of(entries, [](const BlendEntry& e) { return e.pigment != nullptr; }))
    return ask(stops([&](std::size_t i) { return component_of(entries[i].color, component); }), number);
  constant(0);
  for (std::size_t k = 0; k < count && held_; ++k) {
    ask(stops([&](std::size_t i) { return i == k ? 1 : 0; }), number);
    entry(entries[k], component, p);
    op(Op::multiply), op(Op::add);
  }
}

void FormulaMaker::pigment(const Pigment& g, std::uint8_t component, Slot point) {
  if (!held_) return;
  const Slot first = top_;
  if (g.color || g.pattern.kind == Word::none) return constant(component_of(mean_color(g), component));
  if (g.pattern.image || !g.pattern.density_file.empty() || component == height_component) return refuse();
  Transform place = g.to_object;
  for (const Warp& warp : g.pattern.warps) {
    if (warp.kind != Warp::Kind::transform) return refuse();
    place = place * warp.transform;
  }
  if (!is_invertible(place)) return refuse();
  const Slot p = place == Transform{} ? point : moved(inverse(place), point);
  const std::vector<BlendEntry> entries = g.map ? g.map->entries : default_entries(g.pattern);
  if (entries.empty()) return refuse();
  if (g.pattern.kind == Word::average_) {
    average(entries, component, p);
  } else {
    const Slot number = top_;
    const PatternTexture part = part_of(g.pattern, p);
    const std::size_t places = is_of_places(part.kind) ? 0 : places_of_list(g.pattern.kind);
    blend(part, entries, component, places, number, p);
  }
  keep_at(first);
}

// ---- The pattern as a whole

std::size_t places_of_list(Word kind) {
  switch (kind) {
    case Word::checker_:
    case Word::brick_:
    case Word::object_:
      return 2;
    case Word::hexagon_:
      return 3;
    case Word::square_:
      return 4;
    case Word::cubic_:
    case Word::triangular_:
      return 6;
    default:
      return 0;
  }
}

PatternTexture carried(PatternTexture pattern) {
  PatternTexture t;
  t.kind = PatternTexture::Kind::formula;
  t.texture_to_world = std::exchange(pattern.texture_to_world, Transform{});
  pattern.map = {{0, Spectrum{ConstantSpectrum{0}}}, {1, Spectrum{ConstantSpectrum{1}}}};
  FormulaMaker(t).carry(std::move(pattern));
  return t;
}

bool has_kind(const Pattern& pattern) {
  return pattern_kind(pattern.kind) && (pattern.kind != Word::mandel_ || pattern.fractal == PatternFractal{});
}

std::optional<PatternTexture> pattern_record(const Pattern& pattern) {
  PatternTexture t = record_of(pattern);
  if (has_kind(pattern)) return t;
  t.kind = PatternTexture::Kind::formula;
  FormulaMaker maker(t);
  maker.pattern(pattern, 0);
  if (const std::size_t places = places_of_list(pattern.kind)) {
    maker.op(PatternStep::Op::add, 0.5);
    maker.op(PatternStep::Op::multiply, 1 / static_cast<double>(places));
  }
  if (!maker.is_held() || fault_of(t)) return std::nullopt;
  return t;
}

}  // namespace vitrail::pov
