// SPDX-License-Identifier: Apache-2.0
#include "tracer/media/grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vitrail {

namespace {

// The two cells that `x` (in cells, their centres at ½) lies between, and how much each counts.
struct Between {
  int first, second;
  double of_first, of_second;
};
Between between(double x, int cells, GridEdge edge) {
  const double limit = 4.0 * cells + 4;  // far outside is as far as this
  const double at = std::clamp(x - 0.5, -limit, limit), below = std::floor(at);
  const int i = static_cast<int>(below);
  const auto there = [&](int k) {
    return edge == GridEdge::repeated ? ((k % cells) + cells) % cells : std::clamp(k, 0, cells - 1);
  };
  const auto counts = [&](int k, double weight) {
    return edge == GridEdge::zero && (k < 0 || k >= cells) ? 0 : weight;
  };
  const double weight = at - below;
  return {there(i), there(i + 1), counts(i, 1 - weight), counts(i + 1, weight)};
}

// The eight cells around a point, as the first of their values, and how much each of them counts.
struct Corner {
  const float* values;
  double weight;
};
std::array<Corner, 8> corners(const Grid& grid, Point3d p) {
  const Vector3d size = extent(grid.bounds), from = p - grid.bounds.lower;
  const auto axis = [&](int a, int cells) {
    return between(size[a] > 0 ? from[a] / size[a] * cells : 0.5, cells, grid.edge);
  };
  const Between x = axis(0, grid.nx), y = axis(1, grid.ny), z = axis(2, grid.nz);
  std::array<Corner, 8> all;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto side = [&](const Between& b, std::size_t bit) {
      return i & bit ? std::pair{b.second, b.of_second} : std::pair{b.first, b.of_first};
    };
    const auto [cx, wx] = side(x, 1);
    const auto [cy, wy] = side(y, 2);
    const auto [cz, wz] = side(z, 4);
    const auto cell =
        (static_cast<std::size_t>(cz) * static_cast<std::size_t>(grid.ny) + static_cast<std::size_t>(cy)) *
            static_cast<std::size_t>(grid.nx) +
        static_cast<std::size_t>(cx);
    all[i] = {&grid.values[cell * static_cast<std::size_t>(grid.channels)], wx * wy * wz};
  }
  return all;
}

// S(λ) from x at 360, 595 and 830 nm: the parabola through them.
double sigmoid(const float* nodes, double lambda_nm) {
  const double first = static_cast<double>(nodes[0]), middle = static_cast<double>(nodes[1]),
               last = static_cast<double>(nodes[2]), t = (lambda_nm - 595) / 235;
  const double x = middle + t * ((last - first) / 2 + t * ((first + last) / 2 - middle));
  return 0.5 + x / (2 * std::sqrt(1 + x * x));
}

}  // namespace

void look_up_colors(const Grid& grid, Point3d p, std::span<const double> lambda_nm,
                    std::span<double> values) {
  const std::array<Corner, 8> around = corners(grid, p);
  if (grid.edge == GridEdge::zero) {
    std::ranges::fill(values, 0.0);
    for (const Corner& c : around)
      for (std::size_t i = 0; i < values.size() && c.weight > 0; ++i)
        values[i] += c.weight * static_cast<double>(c.values[3]) * sigmoid(c.values, lambda_nm[i]);
    return;
  }
  double scale = 0;
  for (const Corner& c : around) scale += c.weight * static_cast<double>(c.values[3]);
  for (std::size_t i = 0; i < values.size(); ++i) {
    double mean = 0;
    if (scale > 0)
      for (const Corner& c : around)
        if (c.weight > 0) mean += c.weight * sigmoid(c.values, lambda_nm[i]);
    values[i] = scale * mean;
  }
}

double look_up(const Grid& grid, Point3d p, int channel) {
  const Vector3d size = extent(grid.bounds), from = p - grid.bounds.lower;
  const auto axis = [&](int a, int cells) {
    return between(size[a] > 0 ? from[a] / size[a] * cells : 0.5, cells, grid.edge);
  };
  const Between x = axis(0, grid.nx), y = axis(1, grid.ny), z = axis(2, grid.nz);
  const auto value = [&](int i, int j, int k) {
    const auto at =
        (static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.ny) + static_cast<std::size_t>(j)) *
            static_cast<std::size_t>(grid.nx) +
        static_cast<std::size_t>(i);
    return static_cast<double>(
        grid.values[at * static_cast<std::size_t>(grid.channels) + static_cast<std::size_t>(channel)]);
  };
  const auto row = [&](int j, int k) {
    return value(x.first, j, k) * x.of_first + value(x.second, j, k) * x.of_second;
  };
  const auto slice = [&](int k) { return row(y.first, k) * y.of_first + row(y.second, k) * y.of_second; };
  return slice(z.first) * z.of_first + slice(z.second) * z.of_second;
}

double greatest_value(const Grid& grid) {
  if (grid.values.empty()) return 0;
  if (!has_colors(grid))
    return static_cast<double>(*std::max_element(grid.values.begin(), grid.values.end()));
  float greatest = 0;  // of the scales: no sigmoid is above 1
  for (std::size_t i = 3; i < grid.values.size(); i += color_channels)
    greatest = std::max(greatest, grid.values[i]);
  return static_cast<double>(greatest);
}

}  // namespace vitrail
