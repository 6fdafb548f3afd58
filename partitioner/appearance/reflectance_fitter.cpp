// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/reflectance_fitter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <vector>

#include "scene/rgb_to_spectrum.h"

namespace vitrail {

namespace {

using Column3 = std::array<double, 3>;

// ---- The colour of a sigmoid, on every fifth nanometre

constexpr int step_nm = 5;
constexpr std::size_t node_count = (table_size - 1) / step_nm + 1;
constexpr std::size_t lanes = 5;
static_assert(node_count % lanes == 0);

// XYZ under D65 = Σ weight·S(λ) at 360, 365 … 830 nm. Between these S counts as a cubic (Lagrange), so that
// the sum is that over every nanometre with D65 and the observer as they are.
struct Rule {
  std::array<std::array<double, node_count>, 3> weight{};
  std::array<std::array<double, node_count>, 3> basis{};  // of the parabola through x at 360, 595, 830 nm

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
Linearised linearise(const Rule& rule, const Column3& x) {
  std::array<double, node_count> s, slope;
  const double x0 = x[0], x1 = x[1], x2 = x[2];
  for (std::size_t j = 0; j < node_count; ++j) {
    const double v = rule.basis[0][j] * x0 + rule.basis[1][j] * x1 + rule.basis[2][j] * x2;
    const double y = 1 / std::sqrt(1 + v * v);
    s[j] = 0.5 + 0.5 * v * y;
    slope[j] = 0.5 * y * y * y;
  }
  Linearised sum;
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<std::array<double, lanes>, 4> part{};
    for (std::size_t j = 0; j < node_count; j += lanes)
      for (std::size_t i = 0; i < lanes; ++i) {
        const double w = rule.weight[c][j + i], d = w * slope[j + i];
        part[0][i] += w * s[j + i];
        for (std::size_t k = 0; k < 3; ++k) part[k + 1][i] += d * rule.basis[k][j + i];
      }
    for (std::size_t i = 0; i < lanes; ++i) {
      sum.xyz[c] += part[0][i];
      for (std::size_t k = 0; k < 3; ++k) sum.jacobian[c][k] += part[k + 1][i];
    }
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
std::optional<SigmoidNodes> refine(const Rule& rule, Column3 x, const Column3& target) {
  constexpr double close = 2e-3;  // what is left after a step is about its square
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
    if (!(steepness < 50)) return std::nullopt;
    if (greatest < close)
      return SigmoidNodes{static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])};
  }
  return std::nullopt;
}

// ---- Where to start

constexpr int grid_size = 32;
constexpr double edge = 1e-4;  // the grid leaves out what is nearer to 0 or 1

// With v = sin²(πw/2), a grey v has x = tan(πw − π/2): in these terms the angles atan x are nearly linear.
double warp(double v) { return 2 / std::numbers::pi * std::asin(std::sqrt(std::clamp(v, edge, 1 - edge))); }
double unwarp(double w) {
  const double s = std::sin(std::numbers::pi / 2 * w);
  return s * s;
}

}  // namespace

struct ReflectanceFitter::Grid {
  Rule rule;
  const double first = warp(0), spacing = (warp(1) - warp(0)) / (grid_size - 1);
  std::vector<std::once_flag> made = std::vector<std::once_flag>(grid_size * grid_size * grid_size);
  std::vector<Column3> angles = std::vector<Column3>(made.size());  // atan x

  const Column3& vertex(int i, int j, int k) {
    const auto at = static_cast<std::size_t>((i * grid_size + j) * grid_size + k);
    std::call_once(made[at], [&] {
      const auto value = [&](int n) { return unwarp(first + n * spacing); };
      const SigmoidNodes x = nodes_of(reflectance_from_rgb({value(i), value(j), value(k)}));
      for (std::size_t c = 0; c < 3; ++c) angles[at][c] = std::atan(static_cast<double>(x[c]));
    });
    return angles[at];
  }

  Column3 start(RGB color) {
    const std::array<double, 3> rgb{color.r, color.g, color.b};
    std::array<int, 3> cell;
    std::array<double, 3> f;
    for (std::size_t c = 0; c < 3; ++c) {
      const double at = (warp(rgb[c]) - first) / spacing;
      cell[c] = std::clamp(static_cast<int>(at), 0, grid_size - 2);
      f[c] = at - cell[c];
    }
    Column3 angle{};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        for (int k = 0; k < 2; ++k) {
          const double w = (i ? f[0] : 1 - f[0]) * (j ? f[1] : 1 - f[1]) * (k ? f[2] : 1 - f[2]);
          const Column3& at = vertex(cell[0] + i, cell[1] + j, cell[2] + k);
          for (std::size_t c = 0; c < 3; ++c) angle[c] += w * at[c];
        }
    return {std::tan(angle[0]), std::tan(angle[1]), std::tan(angle[2])};
  }
};

ReflectanceFitter::ReflectanceFitter() : grid_(std::make_unique<Grid>()) {}
ReflectanceFitter::~ReflectanceFitter() = default;

SigmoidNodes ReflectanceFitter::operator()(RGB color) const {
  const bool grey = color.r == color.g && color.g == color.b;
  const auto inside = [](double v) { return v > 0 && v < 1; };
  if (!grey && inside(color.r) && inside(color.g) && inside(color.b)) {
    const XYZ xyz = srgb_to_xyz(color);
    if (const auto nodes = refine(grid_->rule, grid_->start(color), {xyz.x, xyz.y, xyz.z})) return *nodes;
  }
  return nodes_of(reflectance_from_rgb(color));
}

}  // namespace vitrail
