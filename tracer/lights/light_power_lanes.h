// SPDX-License-Identifier: Apache-2.0
// This file has LightTree::choose_by_power, for any number of lanes.
#pragma once

#include "tracer/lights/light_tree.h"
#include "tracer/simd/lanes.h"

namespace vitrail::lanes {
namespace {

template <class D>
struct ChosenByPower {
  Mask<D> any;
  std::uint32_t slot[width<D>];
  D probability, rest;
};

// slots(j) are those of lane j, of a tree that has lights. The case of two slots comes first: a lamp of two
// triangles is the commonest.
template <class D, class SlotsOf>
VITRAIL_LANES ChosenByPower<D> choose_by_power(const LightTree& tree, const SlotsOf& slots, D u) {
  constexpr double below_one = 0x1.fffffffffffffp-1;
  const double* const sums = tree.sums().data();
  const D first = gather<D>([&](int j) __attribute__((always_inline)) { return sums[slots(j).begin]; }),
          total = gather<D>([&](int j) __attribute__((always_inline)) { return sums[slots(j).end]; }) - first,
          target = first + u * total;
  ChosenByPower<D> chosen;
  for (int j = 0; j < width<D>; ++j) {
    const LightTree::Slots of = slots(j);
    const double aim = lane(target, j);
    chosen.slot[j] = of.end - of.begin == 2 ? of.begin + (sums[of.begin + 1] <= aim)
                                            : tree.slot_by_power(of, lane(u, j), aim);
  }
  const D below = gather<D>([&](int j) __attribute__((always_inline)) { return sums[chosen.slot[j]]; }),
          power = gather<D>([&](int j) __attribute__((always_inline)) { return sums[chosen.slot[j] + 1]; }) -
                  below;
  chosen.probability = power / total;
  chosen.rest = lanes::min((target - below) / power, fill<D>(below_one));
  chosen.any = (total > 0) & (chosen.probability > 0);  // by rounding, not at the end
  return chosen;
}

}  // namespace
}  // namespace vitrail::lanes
