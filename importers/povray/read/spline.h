// SPDX-License-Identifier: Apache-2.0
// A `spline {}` gives vectors over a parameter.
#pragma once

#include <optional>
#include <vector>

#include "importers/povray/read/symbols.h"

namespace vitrail::pov {

struct Spline {
  enum class Kind { linear, quadratic, cubic, natural };
  struct Knot {
    double at = 0;
    Numbers value;
  };
  Kind kind = Kind::linear;
  std::vector<Knot> knots;  // ascending

  // Beyond its ends the value is that at the end; without knots it is 0. A cubic spline (Catmull and Rom
  // 1974) has values between its second and its last but one knot.
  Numbers at(double parameter, std::optional<Kind> as = {}) const;
  // Adds it in its place; of equal parameters the newer one stays.
  void add(Knot knot);
};

std::optional<Spline::Kind> spline_kind(Word word);

}  // namespace vitrail::pov
