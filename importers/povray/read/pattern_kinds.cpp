// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/pattern_kinds.h"

#include <algorithm>

namespace vitrail::pov {

std::optional<PatternTexture::Kind> pattern_kind(Word word) {
  using Kind = PatternTexture::Kind;
  switch (word) {
    case Word::checker_:
      return Kind::checker;
    case Word::hexagon_:
      return Kind::hexagon;
    case Word::brick_:
      return Kind::brick;
    case Word::gradient_:
      return Kind::gradient;
    case Word::boxed_:
      return Kind::boxed;
    case Word::cylindrical_:
      return Kind::cylindrical;
    case Word::planar_:
      return Kind::planar;
    case Word::spherical_:
      return Kind::spherical;
    case Word::cells_:
      return Kind::cells;
    case Word::leopard_:
      return Kind::leopard;
    case Word::marble_:
      return Kind::marble;
    case Word::onion_:
      return Kind::onion;
    case Word::radial_:
      return Kind::radial;
    case Word::spiral1_:
      return Kind::spiral1;
    case Word::wood_:
      return Kind::wood;
    case Word::agate_:
      return Kind::agate;
    case Word::bozo_:
    case Word::spotted_:
      return Kind::bozo;
    case Word::bumps_:
      return Kind::bumps;
    case Word::crackle_:
      return Kind::crackle;
    case Word::dents_:
      return Kind::dents;
    case Word::granite_:
      return Kind::granite;
    case Word::ripples_:
      return Kind::ripples;
    case Word::waves_:
      return Kind::waves;
    case Word::wrinkles_:
      return Kind::wrinkles;
    case Word::mandel_:
      return Kind::mandel;
    default:
      return std::nullopt;
  }
}

PatternTexture::Wave wave_of(Word wave, Word pattern) {
  using Wave = PatternTexture::Wave;
  switch (wave) {
    case Word::triangle_wave_:
      return Wave::triangle;
    case Word::sine_wave_:
      return Wave::sine;
    case Word::scallop_wave_:
      return Wave::scallop;
    case Word::cubic_wave_:
      return Wave::cubic;
    case Word::poly_wave_:
      return Wave::poly;
    case Word::ramp_wave_:
      return Wave::ramp;
    default:
      return pattern == Word::marble_ || pattern == Word::wood_ || pattern == Word::spiral1_ ||
                     pattern == Word::spiral2_
                 ? Wave::triangle
                 : Wave::ramp;
  }
}

PatternTexture record_of(const Pattern& pattern) {
  PatternTexture t;
  t.kind = pattern_kind(pattern.kind).value_or(t.kind);
  t.turbulence = {pattern.turbulence, std::clamp(pattern.octaves, 1, 10), static_cast<float>(pattern.lambda),
                  static_cast<float>(pattern.omega)};
  t.frequency = static_cast<float>(pattern.frequency);
  t.phase = static_cast<float>(pattern.phase);
  t.wave = wave_of(pattern.wave, pattern.kind);
  t.exponent = static_cast<float>(pattern.wave_exponent);
  t.direction = pattern.direction;
  t.brick = {pattern.brick_size, static_cast<float>(pattern.mortar)};
  t.crackle = {pattern.crackle_form, static_cast<float>(std::max(pattern.crackle_metric, 0.1)),
               static_cast<float>(pattern.crackle_offset), pattern.crackle_solid};
  t.arms = pattern.arms;
  if (pattern.noise) t.noise = *pattern.noise;
  t.agate_turb = static_cast<float>(pattern.agate_turb);
  t.iterations = std::clamp(pattern.iterations, 1, 10000);
  return t;
}

bool is_turbulent_by_itself(PatternTexture::Kind kind) {
  using Kind = PatternTexture::Kind;
  return kind == Kind::agate || kind == Kind::marble || kind == Kind::wood || kind == Kind::spiral1;
}

namespace {

BlendEntry entry(double at, double r, double g, double b) {
  BlendEntry e;
  e.at = at;
  e.color = Finish::grey(0);
  e.color.v = {r, g, b, 0, 0};
  return e;
}

}  // namespace

std::vector<BlendEntry> list_entries(Word pattern) {
  switch (pattern) {
    case Word::checker_:
    case Word::object_:
      return {entry(0, 0, 0, 1), entry(0, 0, 1, 0)};
    case Word::square_:
      return {entry(0, 1, 0, 0), entry(0, 0, 1, 0), entry(0, 0, 0, 1), entry(0, 1, 1, 0)};
    case Word::cubic_:
    case Word::triangular_:
      return {entry(0, 1, 0, 0), entry(0, 0, 1, 0), entry(0, 0, 0, 1),
              entry(0, 1, 1, 0), entry(0, 0, 1, 1), entry(0, 1, 0, 1)};
    case Word::brick_:
      return {entry(0, 0.5, 0.5, 0.5), entry(0, 0.6, 0.15, 0.15)};
    case Word::hexagon_:
      return {entry(0, 0, 0, 1), entry(0, 0, 1, 0), entry(0, 1, 0, 0)};
    default:
      return {};
  }
}

std::vector<BlendEntry> default_entries(const Pattern& pattern) {
  const std::vector<BlendEntry> black_to_white{entry(0, 0, 0, 0), entry(1, 1, 1, 1)};
  switch (pattern.kind) {
    case Word::agate_:
      return {entry(0, 1, 1, 1),         entry(0.5, 0.95, 0.75, 0.5), entry(0.5, 0.9, 0.7, 0.5),
              entry(0.6, 0.9, 0.7, 0.4), entry(0.6, 1, 0.7, 0.4),     entry(1, 0.6, 0.3, 0)};
    case Word::bozo_:
      return {entry(0.4, 1, 1, 1), entry(0.4, 0, 1, 0), entry(0.6, 0, 1, 0),
              entry(0.6, 0, 0, 1), entry(0.8, 0, 0, 1), entry(0.8, 1, 0, 0)};
    case Word::marble_:
      return {entry(0, 0.9, 0.8, 0.8), entry(0.9, 0.9, 0.08, 0.08), entry(0.9, 0, 0, 0)};
    case Word::radial_:
      return {entry(0, 0, 1, 1), entry(0.333, 1, 1, 0), entry(0.666, 1, 0, 1), entry(1, 0, 1, 1)};
    case Word::mandel_:
      if (pattern.fractal != PatternFractal{}) return black_to_white;
      return {entry(0.001, 0, 0, 0), entry(0.001, 0, 1, 1), entry(0.012, 1, 1, 0), entry(0.015, 1, 0, 1),
              entry(0.1, 0, 1, 1)};
    case Word::wood_:
      return {entry(0.6, 0.666, 0.312, 0.2), entry(0.6, 0.4, 0.133, 0.066)};
    default: {
      const std::vector<BlendEntry> list = list_entries(pattern.kind);
      return list.empty() ? black_to_white : list;
    }
  }
}

}  // namespace vitrail::pov
