// SPDX-License-Identifier: Apache-2.0
// These are splines through values at nodes that need not be evenly spaced. They are cubic Hermite. The slope
// at a node is that of the chord between its neighbours (Catmull and Rom 1974). At either end it is that of
// the last interval. Two nodes at one place are a step: an end for either side. (pbrt takes the slope across
// it, and so overshoots beside it.)
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace vitrail {

// They are the weights of values at the nodes first … first + 3: those beyond the ends have the weight 0.
struct SplineWeights {
  std::ptrdiff_t first = 0;
  std::array<double, 4> weight{};
};

// It is the cubic between nodes i and i + 1, t ∈ [0, 1]. It has the values and the slopes by t at the two
// ends.
struct SplineSegment {
  double value0 = 0, value1 = 0, slope0 = 0, slope1 = 0, width = 0;

  double at(double t) const {
    const double rise = value1 - value0, curve = slope0 + slope1 - 2 * rise;
    return value0 + t * (slope0 + t * (rise - slope0 - curve + t * curve));
  }
  // Returns ∫ from the node to t, by the nodes' own unit.
  double integral(double t) const {
    const double rise = value1 - value0, curve = slope0 + slope1 - 2 * rise;
    return width * t * (value0 + t * (slope0 / 2 + t * ((rise - slope0 - curve) / 3 + t * curve / 4)));
  }
};

// Returns the interval i with nodes[i] ≤ x < nodes[i + 1]; the last interval holds its end. It returns
// nothing outside of the nodes.
std::optional<std::size_t> interval_of(std::span<const float> nodes, double x);

// They weigh four values to give the slopes, by t, at the interval's two ends.
struct SlopeWeights {
  std::array<double, 4> at0{}, at1{};
};
SlopeWeights slope_weights(std::span<const float> nodes, std::size_t interval);

std::optional<SplineWeights> spline_weights(std::span<const float> nodes, double x);

// value(i) is the value of node i.
template <class Value>
SplineSegment spline_segment(std::span<const float> nodes, std::size_t interval, const Value& value) {
  const SlopeWeights slopes = slope_weights(nodes, interval);
  SplineSegment s{.width = static_cast<double>(nodes[interval + 1]) - static_cast<double>(nodes[interval])};
  for (std::size_t k = 0; k < 4; ++k) {
    const bool before = k == 0 && interval == 0, after = interval + k > nodes.size();
    if (before || after) continue;
    const double v = value(interval + k - 1);
    s.slope0 += slopes.at0[k] * v, s.slope1 += slopes.at1[k] * v;
    if (k == 1) s.value0 = v;
    if (k == 2) s.value1 = v;
  }
  return s;
}

}  // namespace vitrail
