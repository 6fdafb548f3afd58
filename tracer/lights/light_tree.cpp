// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/light_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace vitrail {

namespace {

// By value and without branches, so that the compiler can take the lanes side by side.
float larger(float a, float b) { return a > b ? a : b; }
float smaller(float a, float b) { return a < b ? a : b; }

float lower_integer(std::uint32_t pair) {
  return static_cast<float>(static_cast<std::int32_t>(pair << 16) >> 16);
}
float upper_integer(std::uint32_t pair) { return static_cast<float>(static_cast<std::int32_t>(pair) >> 16); }
float lower_float(std::uint32_t pair) { return std::bit_cast<float>(pair << 16); }
float upper_float(std::uint32_t pair) { return std::bit_cast<float>(pair & 0xffff0000u); }

// Power · cos θ′ / d², θ′ = θ − θ_o − θ_u the least angle between a normal of the child and the direction to
// p, θ_u the half angle of its sphere from p; 0 where θ′ ≥ θ_e. All angles by cosines and sines.
[[gnu::always_inline]] inline void weigh_lanes(const LightNode& __restrict node, Point3f p,
                                               LightWeights& __restrict result) {
  constexpr float of_unit = 1 / LightNode::unit;
  for (std::size_t i = 0; i < LightNode::width; ++i) {
    const float x = p.x - node.center_x[i], y = p.y - node.center_y[i], z = p.z - node.center_z[i];
    const float d2 = larger(x * x + y * y + z * z, LightNode::least_distance2);
    const float inverse_d = 1 / std::sqrt(d2);
    const float scale = inverse_d * of_unit;
    const float along = (x * lower_integer(node.axis_xy[i]) + y * upper_integer(node.axis_xy[i]) +
                         z * lower_integer(node.axis_z_cos_o[i])) *
                        scale;
    const float signed_radius2 = lower_float(node.radius2_power[i]),
                power = upper_float(node.radius2_power[i]);
    const float radius2 = std::abs(signed_radius2);
    const float turned = signed_radius2 < 0 ? -along : along;
    const float cosine = larger(along, turned);
    const float sine = std::sqrt(larger(0, 1 - cosine * cosine));
    const float sin2_u = smaller(1, radius2 * inverse_d * inverse_d);
    const float sin_u = std::sqrt(sin2_u), cos_u = std::sqrt(1 - sin2_u);
    const float cos_o = upper_integer(node.axis_z_cos_o[i]) * of_unit;
    const float sin_o = std::sqrt(larger(0, 1 - cos_o * cos_o));

    const float cos_beyond_o = cosine * cos_o + sine * sin_o;
    const float sin_beyond_o = sine * cos_o - cosine * sin_o;
    const float cos1 = cosine >= cos_o ? 1.0f : cos_beyond_o;
    const float sin1 = cosine >= cos_o ? 0.0f : sin_beyond_o;
    const float cos_beyond_u = cos1 * cos_u + sin1 * sin_u;
    const float cos_outside = cos1 >= cos_u ? 1.0f : cos_beyond_u;
    const float cos2 = radius2 >= d2 ? 1.0f : cos_outside;
    const float cos_e = power < 0 ? 1 - 1e-4f : 0.0f;
    const float reached = cos2 > cos_e ? cos2 : 0.0f;
    result.lane[i] = std::abs(power) * reached / larger(d2, radius2);
    result.alike[i] = cosine - LightNode::alike_ratio * (sin_u + sin_o);
  }
}

void weigh_portable(const LightNode& __restrict node, Point3f p, LightWeights& __restrict result) {
  weigh_lanes(node, p, result);
}

// Eight lanes at once; the same bits.
#if defined(__x86_64__)
[[gnu::target("avx2")]] void weigh_avx2(const LightNode& __restrict node, Point3f p,
                                        LightWeights& __restrict result) {
  weigh_lanes(node, p, result);
}
const auto weigh = __builtin_cpu_supports("avx2") ? weigh_avx2 : weigh_portable;
#else
constexpr auto weigh = weigh_portable;
#endif

void set_sums(LightWeights& weights) {
  double sum = 0;
  for (std::size_t i = 0; i < LightNode::width; ++i)
    weights.sums[i] = sum += static_cast<double>(weights.lane[i]);
}

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
    const double total = weights.sums.back();
    if (!(total > 0)) return std::nullopt;
    const double target = u * total;
    std::size_t lane = 0;
    for (std::size_t i = 0; i + 1 < LightNode::width; ++i) lane += target >= weights.sums[i];
    while (!(weights.lane[lane] > 0)) --lane;  // by rounding, behind the last
    const auto w = static_cast<double>(weights.lane[lane]);
    u = std::min((target - (lane > 0 ? weights.sums[lane - 1] : 0)) / w, below_one);
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
    set_sums(weights);
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
      set_sums(weights_[place]);
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
    set_sums(weights);
    const double total = weights.sums.back();
    if (!(total > 0)) return 0;
    std::size_t lane = 0;
    for (std::size_t i = 1; i < LightNode::width; ++i) lane += slot >= node.first[i];
    probability *= static_cast<double>(weights.lane[lane]) / total;
    const Slots slots{node.first[lane], node.first[lane + 1]};
    if (slots.end - slots.begin == 1) return probability;
    if (are_alike(node, weights, lane)) return probability * share_of_power(slots, slot);
    n = node_below(node, lane);
  }
}

// The search begins where the slot is if all have the same power, in steps that double.
std::optional<LightTree::Chosen> LightTree::choose_by_power(Slots slots, double u) const {
  const double first = sums_[slots.begin], total = sums_[slots.end] - first;
  if (!(total > 0)) return std::nullopt;
  const double target = first + u * total;
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
  const double share = share_of_power(slots, low);
  if (!(share > 0)) return std::nullopt;  // by rounding, at the end
  return Chosen{low, share, std::min((target - sums_[low]) / (sums_[low + 1] - sums_[low]), below_one)};
}

double LightTree::share_of_power(Slots slots, std::uint32_t slot) const {
  const double total = sums_[slots.end] - sums_[slots.begin];
  return total > 0 ? (sums_[slot + 1] - sums_[slot]) / total : 0;
}

}  // namespace vitrail
