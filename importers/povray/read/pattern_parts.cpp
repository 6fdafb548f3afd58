// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/pattern_parts.h"

#include <algorithm>

#include "importers/povray/read/reader.h"

namespace vitrail::pov {

namespace {

// A direction, and what its values are stretched from.
void read_stretch(Reader& reader, Vector3d& direction, double& low, double& high) {
  direction = reader.vector("a direction");
  reader.comma();
  if (!reader.number_follows()) return;
  low = reader.number("a lower bound");
  reader.comma();
  high = reader.number("an upper bound");
  reader.comma();
}

}  // namespace

void read_fractal(Reader& reader, Word word, Pattern& pattern) {
  PatternFractal& fractal = pattern.fractal;
  fractal = {};
  if (word == Word::magnet_) {
    fractal.kind = reader.integer("the kind of magnet") == 2 ? PatternFractal::Kind::magnet2
                                                             : PatternFractal::Kind::magnet1;
    fractal.is_julia = !reader.accept(Word::mandel_) && reader.accept(Word::julia_);
  }
  fractal.is_julia = fractal.is_julia || word == Word::julia_;
  if (fractal.is_julia) {
    const Numbers seed = reader.numbers();
    fractal.seed = {seed.v[0], seed.terms > 1 ? seed.v[1] : seed.v[0]};
  }
  reader.comma();
  pattern.iterations = reader.integer("the number of iterations");
}

void read_fractal_color(Reader& reader, PatternFractal::Color& color, double& factor) {
  constexpr int last = static_cast<int>(PatternFractal::Color::modulus);
  color = static_cast<PatternFractal::Color>(std::clamp(reader.integer("how points are coloured"), 0, last));
  reader.comma();
  if (reader.number_follows()) factor = reader.number("a factor");
}

void read_slope(Reader& reader, Pattern::Slope& slope) {
  slope = {};
  const bool in_braces = reader.accept('{');
  read_stretch(reader, slope.direction, slope.low, slope.high);
  if (reader.accept(Word::altitude_))
    read_stretch(reader, slope.altitude, slope.low_altitude, slope.high_altitude);
  if (in_braces) reader.expect('}', "at the end of slope");
}

}  // namespace vitrail::pov
