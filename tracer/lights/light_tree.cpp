// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/light_tree.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

// Nearer than this to the centre of a light counts as this far.
constexpr float least_distance2 = 1e-12f;
constexpr double farthest = 1e15;

// Power · cos θ′ / d², θ′ = θ − θ_o − θ_u the least angle between a normal of the child and the direction to
// p, θ_u the half angle of its sphere from p; 0 where θ′ ≥ θ_e. All angles by cosines and sines.
LightNode::Lanes importance(const LightNode& node, Point3f p) {
  LightNode::Lanes result;
  for (std::size_t i = 0; i < LightNode::width; ++i) {
    const float x = p.x - node.center_x[i], y = p.y - node.center_y[i], z = p.z - node.center_z[i];
    const float d2 = std::max(x * x + y * y + z * z, least_distance2);
    const float inverse_d = 1 / std::sqrt(d2);
    float cosine = (x * node.axis_x[i] + y * node.axis_y[i] + z * node.axis_z[i]) * inverse_d;
    cosine = node.two_sided[i] > 0 ? std::abs(cosine) : cosine;
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    const float sin2_u = std::min(1.0f, node.radius2[i] * inverse_d * inverse_d);
    const float sin_u = std::sqrt(sin2_u), cos_u = std::sqrt(1 - sin2_u);

    const bool in_cone = cosine >= node.cos_o[i];
    const float cos1 = in_cone ? 1 : cosine * node.cos_o[i] + sine * node.sin_o[i];
    const float sin1 = in_cone ? 0 : sine * node.cos_o[i] - cosine * node.sin_o[i];
    const bool in_sphere = cos1 >= cos_u || node.radius2[i] >= d2;
    const float cos2 = in_sphere ? 1 : cos1 * cos_u + sin1 * sin_u;
    const float reached = cos2 > node.cos_e[i] ? cos2 : 0;
    result[i] = node.power[i] * reached / std::max(d2, node.radius2[i]);
  }
  return result;
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
    const LightNode::Lanes weight = choice_ == LightChoice::tree ? importance(node, at) : node.power;
    const float total = weight[0] + weight[1] + weight[2] + weight[3];
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
  if (light >= depth_.size() || depth_[light] == 0) return 0;
  const Point3f at = local(p);
  double probability = 1;
  std::uint64_t trail = trail_[light];
  std::int32_t n = 0;
  for (int level = 0; level < depth_[light]; ++level, trail >>= 2) {
    const LightNode& node = nodes_[static_cast<std::size_t>(n)];
    const LightNode::Lanes weight = choice_ == LightChoice::tree ? importance(node, at) : node.power;
    const float total = weight[0] + weight[1] + weight[2] + weight[3];
    if (!(total > 0)) return 0;
    const std::size_t lane = trail & 3;
    probability *= static_cast<double>(weight[lane]) / static_cast<double>(total);
    n = node.child[lane];
  }
  return probability;
}

}  // namespace vitrail
