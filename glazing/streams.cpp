// SPDX-License-Identifier: Apache-2.0
#include "glazing/streams.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace vitrail {

namespace {

// All orders of what two panes reflect to and fro.
double series(double back_of_outside, double front_of_inside) {
  return 1 / (1 - std::min(back_of_outside * front_of_inside, 1 - 1e-12));
}

// What runs in the gap between two panes, of direct light of 1 from outside.
struct Gap {
  double inwards = 0, outwards = 0;                  // direct
  double diffuse_inwards = 0, diffuse_outwards = 0;  // and diffuse

  Gap(const Streams& outside, const Streams& inside) {
    inwards = outside.direct.t * series(outside.direct.rb, inside.direct.rf);
    outwards = inwards * inside.direct.rf;
    const double made_inwards = outside.scattered.t + outside.scattered.rb * outwards,
                 made_outwards = inside.scattered.rf * inwards,
                 all = series(outside.diffuse.rb, inside.diffuse.rf);
    diffuse_inwards = (made_inwards + outside.diffuse.rb * made_outwards) * all;
    diffuse_outwards = (made_outwards + inside.diffuse.rf * made_inwards) * all;
  }
  double all_inwards() const { return inwards + diffuse_inwards; }
  double all_outwards() const { return outwards + diffuse_outwards; }
};

// Seen from inside.
Streams turned(const Streams& s) {
  const auto swapped = [](const PaneValues& v) { return PaneValues{v.t, v.rb, v.rf}; };
  Streams result{swapped(s.direct), swapped(s.scattered), s.scattered.t, swapped(s.diffuse)};
  result.scattered.t = s.scattered_tb;
  return result;
}

// Scattered out of both, of light from outside: to the inside and back.
std::pair<double, double> scattered(const Streams& outside, const Streams& inside) {
  const Gap gap(outside, inside);
  return {
      inside.scattered.t * gap.inwards + inside.diffuse.t * gap.diffuse_inwards,
      outside.scattered.rf + outside.scattered_tb * gap.outwards + outside.diffuse.t * gap.diffuse_outwards};
}

}  // namespace

PaneValues joined(const PaneValues& a, const PaneValues& b) {
  const double all = series(a.rb, b.rf);
  return {a.t * b.t * all, a.rf + a.t * a.t * b.rf * all, b.rb + b.t * b.t * a.rb * all};
}

Streams joined(const Streams& outside, const Streams& inside) {
  Streams whole{joined(outside.direct, inside.direct), {}, 0, joined(outside.diffuse, inside.diffuse)};
  std::tie(whole.scattered.t, whole.scattered.rf) = scattered(outside, inside);
  std::tie(whole.scattered_tb, whole.scattered.rb) = scattered(turned(inside), turned(outside));
  return whole;
}

// What arrives at each pane less what leaves it.
std::vector<double> absorbed_by(const std::vector<Streams>& panes) {
  std::vector<Streams> behind(panes.size(), panes.back());
  for (std::size_t i = panes.size() - 1; i-- > 0;) behind[i] = joined(panes[i], behind[i + 1]);
  std::vector<double> absorbed;
  Streams before = panes.front();
  double inwards = 1, outwards = behind.front().direct.rf + behind.front().scattered.rf;
  for (std::size_t i = 0; i < panes.size(); ++i) {
    if (i > 0) before = joined(before, panes[i]);
    double further = before.t(), back = 0;
    if (i + 1 < panes.size()) {
      const Gap gap(before, behind[i + 1]);
      further = gap.all_inwards(), back = gap.all_outwards();
    }
    absorbed.push_back(std::max(0.0, inwards - outwards - further + back));
    inwards = further, outwards = back;
  }
  return absorbed;
}

}  // namespace vitrail
