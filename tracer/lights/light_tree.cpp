// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/light_tree.h"

#include <algorithm>
#include <cmath>

#include "tracer/lights/light_power_lanes.h"

namespace vitrail {

namespace {

bool are_alike(const LightNode& node, const LightWeights& weights, std::size_t lane) {
  return (node.below[lane] & LightNode::alike) != 0 && weights.alike[lane] > 0;
}

std::size_t node_below(const LightNode& node, std::size_t lane) {
  return node.children + (node.below[lane] & (LightNode::alike - 1u));
}

constexpr double below_one = 0x1.fffffffffffffp-1;

}  // namespace

Point3f LightTree::local(Point3d p) const {
  const auto coordinate = [&](double x, double c) {
    return static_cast<float>(std::clamp((x - c) * scale_, -farthest, farthest));
  };
  return {coordinate(p.x, center_.x), coordinate(p.y, center_.y), coordinate(p.z, center_.z)};
}

template <class WeightsOf>
std::optional<LightTree::Chosen> LightTree::choose_from_root(double u, const WeightsOf& weights_of) const {
  if (nodes_.empty()) return std::nullopt;
  if (choice_ == LightChoice::power) return choose_by_power(all(), u);
  double probability = 1;
  for (std::size_t n = 0;;) {
    const LightNode& node = nodes_[n];
    const LightWeights& weights = weights_of(n);
    const double total = weights.up_to[LightNode::width - 1];
    if (!(total > 0)) return std::nullopt;
    const double target = u * total;
    std::size_t lane = 0;
    for (std::size_t i = 0; i + 1 < LightNode::width; ++i) lane += target >= weights.up_to[i];
    while (!(weights.child[lane] > 0)) --lane;  // by rounding, behind the last
    const auto w = static_cast<double>(weights.child[lane]);
    u = std::min((target - (lane > 0 ? weights.up_to[lane - 1] : 0)) / w, below_one);
    probability *= w / total;
    const Slots slots{node.first[lane], node.first[lane + 1]};
    if (slots.end - slots.begin == 1) return Chosen{slots.begin, probability, u};
    if (are_alike(node, weights, lane)) {
      auto chosen = choose_by_power(slots, u);
      if (chosen) chosen->probability *= probability;
      return chosen;
    }
    n = node_below(node, lane);
  }
}

std::optional<LightTree::Chosen> LightTree::choose(Point3d p, double u) const {
  const Point3f at = local(p);
  LightWeights weights;
  return choose_from_root(u, [&](std::size_t n) -> const LightWeights& {
    weigh(nodes_[n], at, weights);
    return weights;
  });
}

std::optional<LightTree::Chosen> LightTree::Point::choose(double u) {
  return tree_.choose_from_root(u, [&](std::size_t n) -> const LightWeights& {
    const std::size_t place = n % places;
    if (kept_[place] != n) {
      kept_[place] = static_cast<std::uint32_t>(n);
      if (n == 0) local_ = tree_.local(p_);
      weigh(tree_.nodes_[n], local_, weights_[place]);
    }
    return weights_[place];
  });
}

double LightTree::probability(Point3d p, std::uint32_t light) const {
  if (light >= slot_.size() || slot_[light] == absent) return 0;
  const std::uint32_t slot = slot_[light];
  if (choice_ == LightChoice::power) return share_of_power(all(), slot);
  const Point3f at = local(p);
  double probability = 1;
  for (std::size_t n = 0;;) {
    const LightNode& node = nodes_[n];
    LightWeights weights;
    weigh(node, at, weights);
    const double total = weights.up_to[LightNode::width - 1];
    if (!(total > 0)) return 0;
    std::size_t lane = 0;
    for (std::size_t i = 1; i < LightNode::width; ++i) lane += slot >= node.first[i];
    probability *= static_cast<double>(weights.child[lane]) / total;
    const Slots slots{node.first[lane], node.first[lane + 1]};
    if (slots.end - slots.begin == 1) return probability;
    if (are_alike(node, weights, lane)) return probability * share_of_power(slots, slot);
    n = node_below(node, lane);
  }
}

std::optional<LightTree::Chosen> LightTree::choose_by_power(Slots slots, double u) const {
  const auto chosen = lanes::choose_by_power(
      *this, [&](int) { return slots; }, u);
  if (!chosen.any) return std::nullopt;
  return Chosen{chosen.slot[0], chosen.probability, chosen.rest};
}

// The search begins where the slot is if all have the same power, in steps that double.
std::uint32_t LightTree::slot_by_power(Slots slots, double u, double target) const {
  std::uint32_t low = slots.begin, high = slots.end;  // sums_[low] ≤ target
  auto at = low + static_cast<std::uint32_t>(u * (high - low));
  if (sums_[at] > target) {
    for (std::uint32_t step = 1; at > low && sums_[at] > target; step *= 2)
      high = at, at = at - low > step ? at - step : low;
    low = at;
  } else {
    for (std::uint32_t step = 1; at < high && !(sums_[at] > target); step *= 2)
      low = at, at = high - at > step ? at + step : high;
    high = at;
  }
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    (sums_[middle] > target ? high : low) = middle;
  }
  return low;
}

double LightTree::share_of_power(Slots slots, std::uint32_t slot) const {
  const double total = sums_[slots.end] - sums_[slots.begin];
  return total > 0 ? (sums_[slot + 1] - sums_[slot]) / total : 0;
}

}  // namespace vitrail
