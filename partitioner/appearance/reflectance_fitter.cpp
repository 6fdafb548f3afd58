// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/reflectance_fitter.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <vector>

#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

using Column3 = std::array<double, 3>;

// ---- The colour of a sigmoid

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

struct Linearised {
  Column3 xyz{};
  std::array<Column3, 3> jacobian{};  // ∂xyz[row]/∂x[column]
};

// Two loops, of which the first has the √ and ÷ and no sums, which would keep it from being vectorised.
template <int step_nm>
Linearised linearise(const Rule<step_nm>& rule, const Column3& x) {
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
  Linearised sum;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& of = sums[c];
    sum.xyz[c] = of[0][0] + of[0][1];
    sum.jacobian[c] = {of[1][0] + of[1][1], of[2][0] + of[2][1], of[3][0] + of[3][1]};
  }
  return sum;
}

// m·v = r by Cramer's rule; not finite where m is singular.
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

// Newton's method; nothing where it does not converge at once, or the sigmoid is too steep for the rule.
template <int step_nm>
std::optional<SigmoidNodes> refine(const Rule<step_nm>& rule, Column3 x, const Column3& target) {
  constexpr double close = 2e-3;  // what is left after a step is about its square
  constexpr double steepest = 250.0 / step_nm;
  for (int iteration = 0; iteration < 4; ++iteration) {
    const Linearised at = linearise(rule, x);
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

// ---- Where to start

constexpr int grid_size = 32;
constexpr double edge = 1e-5;  // the grid leaves out what is nearer to 0 or 1

// A grey v has x with v = S(x). Of both, w = r/(1 + r) with r = √(v/(1 − v)) = x + √(1 + x²): in these terms
// x is nearly linear in the colour. Roots and divisions alone: they are the same on every machine.
double warp(double v) {
  v = std::clamp(v, edge, 1 - edge);
  const double r = std::sqrt(v / (1 - v));
  return r / (1 + r);
}
double unwarp(double w) {
  const double r = w / (1 - w);
  return r * r / (1 + r * r);
}
double slope_of_unwarp(double w) {
  const double r = w / (1 - w), above = 1 + r, below = 1 + r * r;
  return 2 * r * above * above / (below * below);
}
double warp_x(double x) {
  const double root = std::sqrt(1 + x * x);
  const double r = x < 0 ? 1 / (root - x) : root + x;
  return r / (1 + r);
}
double unwarp_x(double w) {
  const double r = w / (1 - w);
  return (r - 1 / r) / 2;
}

// The fit of some colours, in these terms.
struct Vertex {
  Column3 x{};
  std::array<Column3, 3> half_slope{};  // ½∂x/∂colour, [component of the colour]
};

class Grid {
 public:
  Column3 start(RGB color) {
    const std::array<double, 3> rgb{color.r, color.g, color.b};
    std::array<int, 3> cell;
    std::array<double, 3> f;
    for (std::size_t c = 0; c < 3; ++c) {
      const double at = (warp(rgb[c]) - first_) / spacing_;
      cell[c] = std::clamp(static_cast<int>(at), 0, grid_size - 2);
      f[c] = at - cell[c];
    }
    // Half of the slopes beside the values takes away what linear interpolation leaves of second order.
    Column3 sum{};
    for (int corner = 0; corner < 8; ++corner) {
      const std::array<int, 3> up{corner >> 2, corner >> 1 & 1, corner & 1};
      const Vertex& at = vertex(cell[0] + up[0], cell[1] + up[1], cell[2] + up[2]);
      double weight = 1;
      Column3 value = at.x;
      for (std::size_t c = 0; c < 3; ++c) {
        weight *= up[c] ? f[c] : 1 - f[c];
        const double away = f[c] - up[c];
        for (std::size_t k = 0; k < 3; ++k) value[k] += away * at.half_slope[c][k];
      }
      for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * value[k];
    }
    for (double& w : sum) w = unwarp_x(std::clamp(w, least_warped, 1 - least_warped));
    return sum;
  }

  const Rule<5> coarse;
  const Rule<1> fine;

 private:
  static constexpr double least_warped = 1e-6;

  const Vertex& vertex(int i, int j, int k) {
    const auto at = static_cast<std::size_t>((i * grid_size + j) * grid_size + k);
    if (!made_[at].load(std::memory_order_acquire)) {
      const Vertex made = make({first_ + i * spacing_, first_ + j * spacing_, first_ + k * spacing_});
      const std::lock_guard lock(mutex_);
      if (!made_[at].load(std::memory_order_relaxed)) {
        vertices_[at] = made;
        made_[at].store(true, std::memory_order_release);
      }
    }
    return vertices_[at];
  }

  Vertex make(const Column3& warped) const {
    const SigmoidNodes nodes =
        nodes_of(reflectance_from_rgb({unwarp(warped[0]), unwarp(warped[1]), unwarp(warped[2])}));
    const Column3 x{static_cast<double>(nodes[0]), static_cast<double>(nodes[1]),
                    static_cast<double>(nodes[2])};
    Vertex v;
    for (std::size_t k = 0; k < 3; ++k) v.x[k] = warp_x(x[k]);
    const Linearised at = linearise(fine, x);
    for (std::size_t c = 0; c < 3; ++c) {
      const XYZ xyz = srgb_to_xyz({c == 0 ? 1.0 : 0.0, c == 1 ? 1.0 : 0.0, c == 2 ? 1.0 : 0.0});
      const Column3 slope = solve(at.jacobian, {xyz.x, xyz.y, xyz.z});
      const double step = spacing_ * slope_of_unwarp(warped[c]) / 2;
      for (std::size_t k = 0; k < 3; ++k) {
        const double change = step * slope[k] * v.x[k] * (1 - v.x[k]) / std::sqrt(1 + x[k] * x[k]);
        v.half_slope[c][k] = std::abs(change) < 1 ? change : 0;  // not where the fit is at its limits
      }
    }
    return v;
  }

  const double first_ = warp(0), spacing_ = (warp(1) - warp(0)) / (grid_size - 1);
  std::vector<std::atomic<bool>> made_ = std::vector<std::atomic<bool>>(grid_size * grid_size * grid_size);
  std::vector<Vertex> vertices_ = std::vector<Vertex>(made_.size());
  std::mutex mutex_;
};

// One for all fitters: what it holds depends on nothing.
Grid& grid() {
  static Grid shared;
  return shared;
}

}  // namespace

SigmoidNodes ReflectanceFitter::operator()(RGB color) const {
  const bool grey = color.r == color.g && color.g == color.b;
  const auto inside = [](double v) { return v >= 0 && v <= 1; };
  if (!grey && inside(color.r) && inside(color.g) && inside(color.b)) {
    const XYZ xyz = srgb_to_xyz(color);
    const Column3 start = grid().start(color), target{xyz.x, xyz.y, xyz.z};
    if (const auto nodes = refine(grid().coarse, start, target)) return *nodes;
    if (const auto nodes = refine(grid().fine, start, target)) return *nodes;
  }
  return nodes_of(reflectance_from_rgb(color));
}

}  // namespace vitrail
