// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/pattern_kinds.h"

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
      return pattern == Word::marble_ || pattern == Word::wood_ || pattern == Word::spiral1_ ? Wave::triangle
                                                                                             : Wave::ramp;
  }
}

bool is_of_noise(const PatternTexture& t) {
  using Kind = PatternTexture::Kind;
  return t.turbulence.amount != Vector3d{0, 0, 0} || t.kind == Kind::cells ||
         (t.kind >= Kind::agate && t.kind <= Kind::wrinkles);
}

std::vector<BlendEntry> default_entries(Word pattern) {
  const auto entry = [](double at, double r, double g, double b) {
    BlendEntry e;
    e.at = at;
    e.color = Finish::grey(0);
    e.color.v = {r, g, b, 0, 0};
    return e;
  };
  switch (pattern) {
    case Word::checker_:
      return {entry(0, 0, 0, 1), entry(0, 0, 1, 0)};
    case Word::brick_:
      return {entry(0, 0.5, 0.5, 0.5), entry(0, 0.6, 0.15, 0.15)};
    case Word::hexagon_:
      return {entry(0, 0, 0, 1), entry(0, 0, 1, 0), entry(0, 1, 0, 0)};
    default:
      return {entry(0, 0, 0, 0), entry(1, 1, 1, 1)};
  }
}

}  // namespace vitrail::pov
