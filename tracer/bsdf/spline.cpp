// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/spline.h"

#include <algorithm>

namespace vitrail {

std::optional<std::size_t> interval_of(std::span<const float> nodes, double x) {
  if (!(x >= static_cast<double>(nodes.front()) && x <= static_cast<double>(nodes.back())))
    return std::nullopt;
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), x, [](double value, float node) {
    return value < static_cast<double>(node);
  });
  return std::min(static_cast<std::size_t>(above - nodes.begin()), nodes.size() - 1) - 1;
}

SlopeWeights slope_weights(std::span<const float> nodes, std::size_t i) {
  const auto distance = [&](std::size_t from, std::size_t to) {
    return static_cast<double>(nodes[to]) - static_cast<double>(nodes[from]);
  };
  const double width = distance(i, i + 1);
  SlopeWeights s;
  if (i > 0 && nodes[i - 1] < nodes[i])
    s.at0[2] = width / distance(i - 1, i + 1), s.at0[0] = -s.at0[2];
  else
    s.at0 = {0, -1, 1, 0};
  if (i + 2 < nodes.size() && nodes[i + 1] < nodes[i + 2])
    s.at1[3] = width / distance(i, i + 2), s.at1[1] = -s.at1[3];
  else
    s.at1 = {0, -1, 1, 0};
  return s;
}

std::optional<SplineWeights> spline_weights(std::span<const float> nodes, double x) {
  const auto i = interval_of(nodes, x);
  if (!i) return std::nullopt;
  const auto low = static_cast<double>(nodes[*i]), high = static_cast<double>(nodes[*i + 1]);
  const double t = high > low ? (x - low) / (high - low) : 0;
  // Hermite's four cubics.
  const double t2 = t * t, t3 = t2 * t, value1 = 3 * t2 - 2 * t3, slope0 = t3 - 2 * t2 + t, slope1 = t3 - t2;
  const SlopeWeights slopes = slope_weights(nodes, *i);
  SplineWeights w{.first = static_cast<std::ptrdiff_t>(*i) - 1};
  for (std::size_t k = 0; k < 4; ++k) w.weight[k] = slope0 * slopes.at0[k] + slope1 * slopes.at1[k];
  w.weight[1] += 1 - value1, w.weight[2] += value1;
  return w;
}

}  // namespace vitrail
