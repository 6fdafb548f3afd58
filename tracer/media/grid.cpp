// SPDX-License-Identifier: Apache-2.0
#include "tracer/media/grid.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

// The two cells that `x` (in cells, their centres at ½) lies between, and how far it is to the second.
struct Between {
  int first, second;
  double weight;
};
Between between(double x, int cells, bool clamp) {
  const double limit = 4.0 * cells + 4;  // far outside is as far as this
  const double at = std::clamp(x - 0.5, -limit, limit), below = std::floor(at);
  const int i = static_cast<int>(below);
  const auto wrap = [&](int k) {
    return clamp ? std::clamp(k, 0, cells - 1) : ((k % cells) + cells) % cells;
  };
  return {wrap(i), wrap(i + 1), at - below};
}

}  // namespace

double look_up(const Grid& grid, Point3d p, int channel) {
  const Vector3d size = extent(grid.bounds), from = p - grid.bounds.lower;
  const auto axis = [&](int a, int cells) {
    return between(size[a] > 0 ? from[a] / size[a] * cells : 0.5, cells, grid.clamp);
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
    return value(x.first, j, k) * (1 - x.weight) + value(x.second, j, k) * x.weight;
  };
  const auto slice = [&](int k) { return row(y.first, k) * (1 - y.weight) + row(y.second, k) * y.weight; };
  return slice(z.first) * (1 - z.weight) + slice(z.second) * z.weight;
}

double greatest_value(const Grid& grid) {
  return grid.values.empty() ? 0
                             : static_cast<double>(*std::max_element(grid.values.begin(), grid.values.end()));
}

}  // namespace vitrail
