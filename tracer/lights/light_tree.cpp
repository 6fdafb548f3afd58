// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/light_tree.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

// Nearer than this to the centre of a light counts as this far.
constexpr float least_distance2 = 1e-12f;
constexpr double farthest = 1e15;

// By value and without branches, so that the compiler can take the lanes side by side.
float larger(float a, float b) { return a > b ? a : b; }
float smaller(float a, float b) { return a < b ? a : b; }

// Power · cos θ′ / d², θ′ = θ − θ_o − θ_u the least angle between a normal of the child and the direction to
// p, θ_u the half angle of its sphere from p; 0 where θ′ ≥ θ_e. All angles by cosines and sines.
void importance(const LightNode& node, Point3f p, float* __restrict result) {
  constexpr float of_unit = 1 / LightNode::unit;
  for (std::size_t i = 0; i < LightNode::width; ++i) {
    const float x = p.x - node.center_x[i], y = p.y - node.center_y[i], z = p.z - node.center_z[i];
    const float d2 = larger(x * x + y * y + z * z, least_distance2);
    const float inverse_d = 1 / std::sqrt(d2);
    const float scale = inverse_d * of_unit;
    const float along = (x * static_cast<float>(node.axis_x[i]) + y * static_cast<float>(node.axis_y[i]) +
                         z * static_cast<float>(node.axis_z[i])) *
                        scale;
    const float turned = node.radius2[i] < 0 ? -along : along;
    const float cosine = larger(along, turned);
    const float sine = std::sqrt(larger(0, 1 - cosine * cosine));
    const float radius2 = std::abs(node.radius2[i]);
    const float sin2_u = smaller(1, radius2 * inverse_d * inverse_d);
    const float sin_u = std::sqrt(sin2_u), cos_u = std::sqrt(1 - sin2_u);
    const float cos_o = static_cast<float>(node.cos_o[i]) * of_unit;
    const float sin_o = std::sqrt(larger(0, 1 - cos_o * cos_o));

    const float cos_beyond_o = cosine * cos_o + sine * sin_o;
    const float sin_beyond_o = sine * cos_o - cosine * sin_o;
    const float cos1 = cosine >= cos_o ? 1.0f : cos_beyond_o;
    const float sin1 = cosine >= cos_o ? 0.0f : sin_beyond_o;
    const float cos_beyond_u = cos1 * cos_u + sin1 * sin_u;
    const float cos_outside = cos1 >= cos_u ? 1.0f : cos_beyond_u;
    const float cos2 = radius2 >= d2 ? 1.0f : cos_outside;
    const float cos_e = node.power[i] < 0 ? 1 - 1e-4f : 0.0f;
    const float reached = cos2 > cos_e ? cos2 : 0.0f;
    result[i] = std::abs(node.power[i]) * reached / larger(d2, radius2);
  }
}

struct Weights {
  LightNode::Lanes lane;
  float total;
};
Weights weigh(const LightNode& node, Point3f p, LightChoice choice) {
  Weights w;
  if (choice == LightChoice::tree)
    importance(node, p, w.lane.data());
  else
    for (std::size_t i = 0; i < LightNode::width; ++i) w.lane[i] = std::abs(node.power[i]);
  const LightNode::Lanes& l = w.lane;
  w.total = ((l[0] + l[4]) + (l[1] + l[5])) + ((l[2] + l[6]) + (l[3] + l[7]));
  return w;
}

}  // namespace

Point3f LightTree::local(Point3d p) const {
  const auto coordinate = [&](double x, double c) {
    return static_cast<float>(std::clamp((x - c) * scale_, -farthest, farthest));
  };
  return {coordinate(p.x, center_.x), coordinate(p.y, center_.y), coordinate(p.z, center_.z)};
}

std::optional<LightTree::Chosen> LightTree::choose(Point3d p, double u) const {
  if (nodes_.empty()) return std::nullopt;
  const Point3f at = local(p);
  double probability = 1;
  for (std::int32_t n = 0;;) {
    const LightNode& node = nodes_[static_cast<std::size_t>(n)];
    const auto [weight, total] = weigh(node, at, choice_);
    if (!(total > 0)) return std::nullopt;
    double rest = u * static_cast<double>(total);
    std::size_t lane = 0, last = 0;
    for (; lane < LightNode::width; ++lane) {
      if (!(weight[lane] > 0)) continue;
      last = lane;
      const auto w = static_cast<double>(weight[lane]);
      if (rest < w) break;
      rest -= w;
    }
    if (lane == LightNode::width) lane = last;  // by rounding
    const auto w = static_cast<double>(weight[lane]);
    u = std::min(rest / w, 0x1.fffffffffffffp-1);
    probability *= w / static_cast<double>(total);
    n = node.child[lane];
    if (n < 0) return Chosen{static_cast<std::uint32_t>(~n), probability};
  }
}

double LightTree::probability(Point3d p, std::uint32_t light) const {
  if (light >= trail_.size() || trail_[light] == 0) return 0;
  const Point3f at = local(p);
  double probability = 1;
  std::int32_t n = 0;
  for (std::uint64_t trail = trail_[light]; trail > 1; trail >>= 3) {
    const LightNode& node = nodes_[static_cast<std::size_t>(n)];
    const auto [weight, total] = weigh(node, at, choice_);
    if (!(total > 0)) return 0;
    const std::size_t lane = trail & 7;
    probability *= static_cast<double>(weight[lane]) / static_cast<double>(total);
    n = node.child[lane];
  }
  return probability;
}

}  // namespace vitrail
