// SPDX-License-Identifier: Apache-2.0
#include "bundle/reflectances/sigmoid_newton.h"

#include <algorithm>
#include <cmath>

#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

// Two nodes at a time.
using Pair = double __attribute__((vector_size(16)));

// XYZ under D65 = Σ weight·S(λ) at 360 nm, 360 nm + step … 830 nm. Between these S counts as a cubic
// (Lagrange), so that the sum is that over every nanometre with D65 and the observer as they are.
template <int step_nm>
struct Rule {
  static constexpr std::size_t node_count = (table_size - 1) / step_nm + 1;
  static constexpr std::size_t padded_count = node_count + node_count % 2;  // those beyond have no weight
  using Nodes = std::array<double, padded_count>;

  std::array<Nodes, 3> weight{};
  std::array<Nodes, 3> basis{};  // of the parabola through x at 360, 595, 830 nm

  Rule() {
    for (std::size_t i = 0; i < table_size; ++i) {
      const double at = static_cast<double>(i) / step_nm;
      const auto first =
          static_cast<std::size_t>(std::clamp(std::floor(at) - 1, 0.0, static_cast<double>(node_count - 4)));
      for (std::size_t j = first; j < first + 4; ++j) {
        double l = 1;
        for (std::size_t k = first; k < first + 4; ++k)
          if (k != j) l *= (at - static_cast<double>(k)) / (static_cast<double>(j) - static_cast<double>(k));
        for (std::size_t c = 0; c < 3; ++c)
          weight[c][j] += l * static_cast<double>(cie_d65()[i]) * static_cast<double>(cie_1931()[i][c]) /
                          cie_y_integral_nm;
      }
    }
    for (std::size_t j = 0; j < node_count; ++j) {
      const double t = 2 * static_cast<double>(j) / (node_count - 1) - 1;
      basis[0][j] = t * (t - 1) / 2, basis[1][j] = 1 - t * t, basis[2][j] = t * (t + 1) / 2;
    }
  }
};

// Two loops, of which the first has the √ and ÷ and no sums, which would keep it from being vectorised.
template <int step_nm>
LinearisedColor linearise(const Rule<step_nm>& rule, const Column3& x) {
  constexpr std::size_t count = Rule<step_nm>::padded_count;
  std::array<typename Rule<step_nm>::Nodes, 4> values;  // S, and its slopes by the three x
  const double x0 = x[0], x1 = x[1], x2 = x[2];
  for (std::size_t j = 0; j < count; ++j) {
    const double v = rule.basis[0][j] * x0 + rule.basis[1][j] * x1 + rule.basis[2][j] * x2;
    const double y = 1 / std::sqrt(1 + v * v);
    const double slope = 0.5 * y * y * y;
    values[0][j] = 0.5 + 0.5 * v * y;
    values[1][j] = slope * rule.basis[0][j];
    values[2][j] = slope * rule.basis[1][j];
    values[3][j] = slope * rule.basis[2][j];
  }
  std::array<std::array<Pair, 4>, 3> sums{};
  for (std::size_t j = 0; j < count; j += 2)
    for (std::size_t c = 0; c < 3; ++c) {
      const Pair w{rule.weight[c][j], rule.weight[c][j + 1]};
      for (std::size_t k = 0; k < 4; ++k) sums[c][k] += w * Pair{values[k][j], values[k][j + 1]};
    }
  LinearisedColor sum;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& of = sums[c];
    sum.xyz[c] = of[0][0] + of[0][1];
    sum.jacobian[c] = {of[1][0] + of[1][1], of[2][0] + of[2][1], of[3][0] + of[3][1]};
  }
  return sum;
}

// Newton's method; nothing where it does not converge at once, or the sigmoid is too steep for the rule.
template <int step_nm>
std::optional<SigmoidNodes> refine(const Rule<step_nm>& rule, Column3 x, const Column3& target) {
  constexpr double close = 2e-3;  // what is left after a step is about its square
  constexpr double steepest = 250.0 / step_nm;
  for (int iteration = 0; iteration < 4; ++iteration) {
    const LinearisedColor at = linearise(rule, x);
    const Column3 step =
        solve(at.jacobian, {target[0] - at.xyz[0], target[1] - at.xyz[1], target[2] - at.xyz[2]});
    double greatest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      greatest = std::max(greatest, std::abs(step[k]) / (1 + std::abs(x[k])));
      x[k] += step[k];
    }
    if (!(greatest < 1)) return std::nullopt;
    const double steepness = std::max(std::abs(x[1] - x[0]), std::abs(x[2] - x[1]));
    if (!(steepness < steepest)) return std::nullopt;
    if (greatest < close)
      return SigmoidNodes{static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])};
  }
  return std::nullopt;
}

const Rule<1>& every_nm() {
  static const Rule<1> rule;
  return rule;
}
const Rule<5>& every_fifth_nm() {
  static const Rule<5> rule;
  return rule;
}

}  // namespace

Column3 solve(const std::array<Column3, 3>& m, const Column3& r) {
  const auto cross = [](const Column3& a, const Column3& b) {
    return Column3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Column3 c12 = cross(m[1], m[2]), c20 = cross(m[2], m[0]), c01 = cross(m[0], m[1]);
  const double det = m[0][0] * c12[0] + m[0][1] * c12[1] + m[0][2] * c12[2];
  Column3 v;
  for (std::size_t k = 0; k < 3; ++k) v[k] = (r[0] * c12[k] + r[1] * c20[k] + r[2] * c01[k]) / det;
  return v;
}

LinearisedColor linearised_color(const Column3& x) { return linearise(every_nm(), x); }

std::optional<SigmoidNodes> refined_sigmoid(const Column3& start, const Column3& xyz) {
  if (const auto nodes = refine(every_fifth_nm(), start, xyz)) return nodes;
  return refine(every_nm(), start, xyz);
}

std::optional<SigmoidNodes> finely_refined_sigmoid(const Column3& start, const Column3& xyz) {
  const auto near = refine(every_fifth_nm(), start, xyz);
  if (!near) return refine(every_nm(), start, xyz);
  return refine(
      every_nm(),
      {static_cast<double>((*near)[0]), static_cast<double>((*near)[1]), static_cast<double>((*near)[2])},
      xyz);
}

}  // namespace vitrail
