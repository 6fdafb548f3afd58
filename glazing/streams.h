// SPDX-License-Identifier: Apache-2.0
// Streams are light in panes of which some scatter. Direct light comes at one angle and goes straight on or
// is mirrored; panes scatter a part of it. Scattered light is diffuse from there on: it comes from all of the
// hemisphere alike, as Lambert's law has it, also behind the next pane.
#pragma once

#include <vector>

#include "glazing/optical_rows.h"

namespace vitrail {

// Returns two panes, or groups of panes, as one; the first is outside. It sums all reflections
// between them, a geometric series.
PaneValues joined(const PaneValues& outside, const PaneValues& inside);

// Streams say what a pane, or panes together, do with light of 1.
struct Streams {
  PaneValues direct;        // of direct light: what stays direct
  PaneValues scattered;     // of direct light: what becomes diffuse; t of light from the front
  double scattered_tb = 0;  // and t of light from the back
  PaneValues diffuse;       // of diffuse light, which stays diffuse

  double t() const { return direct.t + scattered.t; }
};
Streams joined(const Streams& outside, const Streams& inside);

// Returns which share of direct light from outside each pane absorbs, `panes` from outside: with
// t and rf of the whole they sum to 1.
std::vector<double> absorbed_by(const std::vector<Streams>& panes);

}  // namespace vitrail
