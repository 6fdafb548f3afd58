// SPDX-License-Identifier: Apache-2.0
// This file has LightTree::choose for W points at once, level by level. The weights of a node's eight
// children stand side by side, and no branch lies between the points.
#pragma once

#include "tracer/lights/light_power_lanes.h"
#include "tracer/lights/light_weights_lanes.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

// It holds LightTree::Chosen for each lane that chose a light.
template <int W>
struct ChosenLights {
  std::uint32_t slot[W];
  double probability[W], rest[W];
  bool any[W];
};

// Chooses by power among slots[j] for the lanes of `of`; one of slots[j] is chosen with the probability
// chosen.probability[j].
template <class D>
VITRAIL_LANES void choose_alike(const LightTree& tree, const LightTree::Slots (&slots)[width<D>], unsigned of,
                                const double (&rest)[width<D>], ChosenLights<width<D>>& chosen) {
  const ChosenByPower<D> one = choose_by_power<D>(
      tree, [&](int j) __attribute__((always_inline))->const LightTree::Slots& { return slots[j]; },
      gather<D>([&](int j) __attribute__((always_inline)) { return rest[j]; }));
  for (int j = 0; j < width<D>; ++j) {
    if (!(of >> j & 1)) continue;
    chosen.any[j] = is_set(one.any, j);
    chosen.slot[j] = one.slot[j], chosen.rest[j] = lane(one.rest, j);
    chosen.probability[j] = lane(one.probability, j) * chosen.probability[j];
  }
}

// Chooses for the lanes that are `wanted`. `root` keeps the weights of the root's children for the points;
// `root_known` says that a call for the same points has left them there.
template <class D>
VITRAIL_LANES void choose_lights(const LightTree& tree, Vector<D> p, D u, Mask<D> wanted,
                                 LightWeights (&root)[width<D>], bool root_known,
                                 ChosenLights<width<D>>& chosen) {
  constexpr int W = width<D>;
  constexpr double below_one = 0x1.fffffffffffffp-1;
  const LightNode* const nodes = tree.node_list().data();
  Point3f at[W];
  const LightNode* node[W];
  double rest[W];
  unsigned open = tree.empty() ? 0 : bits(wanted);
  for (int j = 0; j < W; ++j) {
    chosen.any[j] = false;
    chosen.slot[j] = 0, chosen.probability[j] = 1, chosen.rest[j] = 0;
    rest[j] = lane(u, j);
    node[j] = nodes;
  }
  if (open == 0) return;
  // These lanes go on by power. They wait for all lanes, and `alike` has the slots that each chooses among.
  unsigned powered = 0;
  LightTree::Slots alike[W]{};
  if (tree.choice() == LightChoice::power) {
    for (int j = 0; j < W; ++j) alike[j] = tree.all();
    powered = open, open = 0;
  }
  const D least = fill<D>(-LightTree::farthest), most = fill<D>(LightTree::farthest);
  const auto coordinate = [&](D x, double center) __attribute__((always_inline)) {
    const D local = (x - center) * tree.scale();
    return to_floats(select<D>(local < least, least, select<D>(most < local, most, local)));
  };
  const FloatsLike<D> x = coordinate(p.x, tree.center().x), y = coordinate(p.y, tree.center().y),
                      z = coordinate(p.z, tree.center().z);
  for (int j = 0; j < W; ++j) at[j] = {lane(x, j), lane(y, j), lane(z, j)};

  LightWeights below[W];
  for (bool first = true; open != 0; first = false) {
    LightWeights* const weights = first ? root : below;
    if (!first || !root_known)
      for (int j = 0; j < W; ++j) lanes::weigh(*node[j], at[j], weights[j]);
    double target[W];
    std::uint32_t child[W];
    for (int j = 0; j < W; ++j) {
      const LightWeights& w = weights[j];
      target[j] = rest[j] * w.up_to[7];
      child[j] = 0;
      for (int i = 0; i < 7; ++i) child[j] += target[j] >= w.up_to[i];
    }
    for (int j = 0; j < W; ++j) {
      if (!(open >> j & 1)) continue;
      open &= ~(1u << j);
      const LightWeights& w = weights[j];
      const double total = w.up_to[7];
      if (!(total > 0)) continue;
      std::uint32_t i = child[j];
      while (!(w.child[i] > 0)) --i;  // by rounding, behind the last
      const auto weight = static_cast<double>(w.child[i]);
      const double within = (target[j] - (i > 0 ? w.up_to[i - 1] : 0)) / weight;
      rest[j] = below_one < within ? below_one : within;
      chosen.probability[j] *= weight / total;
      const LightNode& n = *node[j];
      const LightTree::Slots slots{n.first[i], n.first[i + 1]};
      if (slots.end - slots.begin == 1) {
        chosen.slot[j] = slots.begin, chosen.rest[j] = rest[j], chosen.any[j] = true;
      } else if ((n.below[i] & LightNode::alike) != 0 && w.alike[i] > 0) {
        alike[j] = slots, powered |= 1u << j;
      } else {
        node[j] = nodes + n.children + (n.below[i] & (LightNode::alike - 1u));
        open |= 1u << j;
      }
    }
  }
  if (powered != 0) choose_alike<D>(tree, alike, powered, rest, chosen);
}

}  // namespace
}  // namespace vitrail::lanes
