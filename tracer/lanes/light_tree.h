// SPDX-License-Identifier: Apache-2.0
// LightTree::choose for W points at once, level by level: the weights of a node's eight children stand side
// by side, and no branch lies between the points.
#pragma once

#include "tracer/lanes/vectors.h"
#include "tracer/lights/light_tree.h"

namespace vitrail::lanes {
namespace {

// What a node's children can send to a point.
struct alignas(64) NodeWeights {
  Floats<8> child;
  Floats<8> alike;  // > 0: the lights of the child are alike
  double up_to[8];  // sums of the children's weights up to each
};

namespace detail {

VITRAIL_LANES Floats<8> load(const LightNode::Lanes& x) { return std::bit_cast<Floats<8>>(x); }
VITRAIL_LANES Words<8> load(const LightNode::Pairs& x) { return std::bit_cast<Words<8>>(x); }
VITRAIL_LANES Floats<8> lower_integer(Words<8> pair) {
  return to_floats(cast_bits<std::int32_t>(pair << 16) >> 16);
}
VITRAIL_LANES Floats<8> upper_integer(Words<8> pair) {
  return to_floats(cast_bits<std::int32_t>(pair) >> 16);
}

// The operations of light_tree.cpp's weigh, in its order.
VITRAIL_LANES void weigh(const LightNode& node, Point3f p, NodeWeights& result) {
  using F = Floats<8>;
  constexpr float of_unit = 1 / LightNode::unit, least_distance2 = LightNode::least_distance2;
  const auto larger = [](F a, F b) __attribute__((always_inline)) { return select<F>(a > b, a, b); };
  const auto one = fill<F>(1), zero = fill<F>(0);
  const F x = p.x - load(node.center_x), y = p.y - load(node.center_y), z = p.z - load(node.center_z);
  const F d2 = larger(x * x + y * y + z * z, fill<F>(least_distance2));
  const F inverse_d = 1.0f / lanes::sqrt(d2), scale = inverse_d * of_unit;
  const Words<8> axis_xy = load(node.axis_xy), axis_z_cos_o = load(node.axis_z_cos_o),
                 radius2_power = load(node.radius2_power);
  const F along =
      (x * lower_integer(axis_xy) + y * upper_integer(axis_xy) + z * lower_integer(axis_z_cos_o)) * scale;
  const F signed_radius2 = cast_bits<float>(radius2_power << 16),
          power = cast_bits<float>(radius2_power & 0xffff0000u);
  const F radius2 = abs(signed_radius2);
  const F turned = select<F>(signed_radius2 < 0, -along, along);
  const F cosine = larger(along, turned);
  const F sine = lanes::sqrt(larger(zero, 1.0f - cosine * cosine));
  const F share = radius2 * inverse_d * inverse_d, sin2_u = select<F>(one < share, one, share);
  const F sin_u = lanes::sqrt(sin2_u), cos_u = lanes::sqrt(1.0f - sin2_u);
  const F cos_o = upper_integer(axis_z_cos_o) * of_unit;
  const F sin_o = lanes::sqrt(larger(zero, 1.0f - cos_o * cos_o));

  const F cos_beyond_o = cosine * cos_o + sine * sin_o;
  const F sin_beyond_o = sine * cos_o - cosine * sin_o;
  const F cos1 = select<F>(cosine >= cos_o, one, cos_beyond_o);
  const F sin1 = select<F>(cosine >= cos_o, zero, sin_beyond_o);
  const F cos_beyond_u = cos1 * cos_u + sin1 * sin_u;
  const F cos_outside = select<F>(cos1 >= cos_u, one, cos_beyond_u);
  const F cos2 = select<F>(radius2 >= d2, one, cos_outside);
  const F cos_e = select<F>(power < 0, fill<F>(1 - 1e-4f), zero);
  const F reached = select<F>(cos2 > cos_e, cos2, zero);
  result.child = abs(power) * reached / larger(d2, radius2);
  result.alike = cosine - LightNode::alike_ratio * (sin_u + sin_o);
  double sum = 0;
  for (int i = 0; i < 8; ++i) result.up_to[i] = sum += static_cast<double>(result.child[i]);
}

}  // namespace detail

// Of each lane that chose a light: LightTree::Chosen.
template <int W>
struct ChosenLights {
  std::uint32_t slot[W];
  double probability[W], rest[W];
  bool any[W];
};

// For the lanes that are `wanted`. `root` keeps what the root's children weigh for the points: `root_known`
// where a call for the same points has left it there.
template <class D>
VITRAIL_LANES void choose_lights(const LightTree& tree, Vector<D> p, D u, Mask<D> wanted,
                                 NodeWeights (&root)[width<D>], bool root_known,
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
  const auto take_by_power = [&](int j, LightTree::Slots slots) __attribute__((always_inline)) {
    const auto one = tree.choose_by_power(slots, rest[j]);
    chosen.any[j] = one.has_value();
    if (!one) return;
    chosen.slot[j] = one->slot, chosen.rest[j] = one->rest;
    chosen.probability[j] = one->probability * chosen.probability[j];
  };
  if (tree.choice() == LightChoice::power) {
    for (int j = 0; j < W; ++j)
      if (open >> j & 1) take_by_power(j, tree.all());
    return;
  }
  const D least = fill<D>(-LightTree::farthest), most = fill<D>(LightTree::farthest);
  const auto coordinate = [&](D x, double center) __attribute__((always_inline)) {
    const D local = (x - center) * tree.scale();
    return to_floats(select<D>(local < least, least, select<D>(most < local, most, local)));
  };
  const FloatsLike<D> x = coordinate(p.x, tree.center().x), y = coordinate(p.y, tree.center().y),
                      z = coordinate(p.z, tree.center().z);
  for (int j = 0; j < W; ++j) at[j] = {lane(x, j), lane(y, j), lane(z, j)};

  NodeWeights below[W];
  for (bool first = true; open != 0; first = false) {
    NodeWeights* const weights = first ? root : below;
    if (!first || !root_known)
      for (int j = 0; j < W; ++j) detail::weigh(*node[j], at[j], weights[j]);
    double target[W];
    std::uint32_t child[W];
    for (int j = 0; j < W; ++j) {
      const NodeWeights& w = weights[j];
      target[j] = rest[j] * w.up_to[7];
      child[j] = 0;
      for (int i = 0; i < 7; ++i) child[j] += target[j] >= w.up_to[i];
    }
    for (int j = 0; j < W; ++j) {
      if (!(open >> j & 1)) continue;
      open &= ~(1u << j);
      const NodeWeights& w = weights[j];
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
        take_by_power(j, slots);
      } else {
        node[j] = nodes + n.children + (n.below[i] & (LightNode::alike - 1u));
        open |= 1u << j;
      }
    }
  }
}

}  // namespace
}  // namespace vitrail::lanes
