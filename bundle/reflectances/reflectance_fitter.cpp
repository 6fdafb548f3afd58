// SPDX-License-Identifier: Apache-2.0
#include "bundle/reflectances/reflectance_fitter.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <vector>

#include "bundle/reflectances/sigmoid_newton.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

constexpr int grid_size = 32;
constexpr std::size_t grid_points = std::size_t{grid_size} * grid_size * grid_size;
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

class StartGrid {
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
    const LinearisedColor at = linearised_color(x);
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
  std::vector<std::atomic<bool>> made_ = std::vector<std::atomic<bool>>(grid_points);
  std::vector<Vertex> vertices_ = std::vector<Vertex>(made_.size());
  std::mutex mutex_;
};

// One for all fitters: what it holds depends on nothing.
StartGrid& grid() {
  static StartGrid shared;
  return shared;
}

}  // namespace

SigmoidNodes ReflectanceFitter::operator()(RGB color) const {
  const bool grey = color.r == color.g && color.g == color.b;
  const auto inside = [](double v) { return v >= 0 && v <= 1; };
  if (!grey && inside(color.r) && inside(color.g) && inside(color.b)) {
    const XYZ xyz = srgb_to_xyz(color);
    const Column3 start = grid().start(color), target{xyz.x, xyz.y, xyz.z};
    if (const auto nodes = refined_sigmoid(start, target)) return *nodes;
  }
  return nodes_of(reflectance_from_rgb(color));
}

}  // namespace vitrail
