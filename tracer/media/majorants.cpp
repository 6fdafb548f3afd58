// SPDX-License-Identifier: Apache-2.0
#include "tracer/media/majorants.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracer/media/grid.h"

namespace vitrail {

namespace {

// Cells of the grids along an axis that share a range: fewer cost more steps, more more collisions.
constexpr double shared_cells = 4;
constexpr int most_ranges = 128;  // along an axis
constexpr double no_plane = std::numeric_limits<double>::infinity();

float rounded_down(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, 0.0f) : f;
}
float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

struct Range {
  double low = 0, high = 0;
};
Range operator+(Range a, Range b) { return {a.low + b.low, a.high + b.high}; }
Range operator*(Range a, Range b) { return {a.low * b.low, a.high * b.high}; }  // of numbers ≥ 0

// The parameters that extinction is the sum of; the second may be null.
std::array<const VolumeParameter*, 2> extinctions(const Medium& medium) {
  if (const auto* e = std::get_if<ExtinctionAlbedo>(&medium.coefficients)) return {&e->sigma_t, nullptr};
  const auto& k = std::get<AbsorptionScattering>(medium.coefficients);
  return {&k.sigma_a, &k.sigma_s};
}

// What extinction is made of: grids that are added up, and one that multiplies the sum.
struct Factors {
  double scale;
  const Grid* density;
  std::array<const Grid*, 2> added{};
};
Factors factors_of(const Medium& medium) {
  Factors f{static_cast<double>(medium.scale), std::get_if<Grid>(&medium.density)};
  const auto extinction = extinctions(medium);
  for (std::size_t i = 0; i < extinction.size(); ++i)
    if (extinction[i]) f.added[i] = std::get_if<Grid>(extinction[i]);
  return f;
}

Range range_of(const std::vector<GridRange>& ranges, std::size_t cell) {
  return {static_cast<double>(ranges[cell].low), static_cast<double>(ranges[cell].high)};
}

// Along each axis as many as the finest grid asks for.
std::array<int, 3> cells_of(const Factors& f, const Bounds3d& bounds) {
  std::array<int, 3> cells{1, 1, 1};
  for (const Grid* grid : {f.density, f.added[0], f.added[1]}) {
    if (!grid) continue;
    const std::array<int, 3> count{grid->nx, grid->ny, grid->nz};
    for (int axis = 0; axis < 3; ++axis) {
      const double size = extent(grid->bounds)[axis];
      if (!(size > 0)) continue;
      const double wanted =
          std::ceil(extent(bounds)[axis] / size * count[static_cast<std::size_t>(axis)] / shared_cells);
      int& n = cells[static_cast<std::size_t>(axis)];
      n = std::max(n, static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(most_ranges))));
    }
  }
  return cells;
}

}  // namespace

ExtinctionGrid bound_extinction(const Medium& medium, const Bounds3d& bounds) {
  const Factors factors = factors_of(medium);
  ExtinctionGrid g{bounds};
  if (!bounds.empty()) g.cells = cells_of(factors, bounds);
  Planes planes;
  for (int axis = 0; axis < 3 && !bounds.empty(); ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for (int i = 0; i <= g.cells[a]; ++i)
      planes[a].push_back(
          std::lerp(bounds.lower[axis], bounds.upper[axis], static_cast<double>(i) / g.cells[a]));
  }
  const auto ranges_of = [&](const Grid* grid) {
    return grid ? value_ranges(*grid, planes) : std::vector<GridRange>{};
  };
  const auto density = ranges_of(factors.density), first = ranges_of(factors.added[0]),
             second = ranges_of(factors.added[1]);
  g.ranges.resize(static_cast<std::size_t>(g.cells[0]) * static_cast<std::size_t>(g.cells[1]) *
                  static_cast<std::size_t>(g.cells[2]));
  for (std::size_t cell = 0; cell < g.ranges.size(); ++cell) {
    Range scale{factors.scale, factors.scale}, sum;
    if (factors.density) scale = scale * range_of(density, cell);
    if (factors.added[0]) sum = sum + range_of(first, cell);
    if (factors.added[1]) sum = sum + range_of(second, cell);
    sum = scale * sum;
    g.ranges[cell] = {rounded_down(scale.low), rounded_up(scale.high), rounded_down(sum.low),
                      rounded_up(sum.high)};
  }
  return g;
}

CellWalk::CellWalk(const ExtinctionGrid& grid, Point3d p, Vector3d d, double first, double last)
    : grid_(grid), begin_(first), last_(last) {
  std::ptrdiff_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const int count = grid.cells[a];
    const double size = extent(grid.bounds)[axis] / count;
    int cell = 0;
    if (count > 1) {
      const double at = (p[axis] + d[axis] * first - grid.bounds.lower[axis]) / size;
      cell = static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
    }
    const bool up = d[axis] > 0;
    left_[a] = up ? count - 1 - cell : cell;
    const bool leaves = left_[a] > 0 && d[axis] != 0;
    next_[a] =
        leaves ? (grid.bounds.lower[axis] + size * (up ? cell + 1 : cell) - p[axis]) / d[axis] : no_plane;
    step_[a] = leaves ? size / std::abs(d[axis]) : 0;
    stride_[a] = up ? stride : -stride;
    cell_ += static_cast<std::size_t>(cell * stride);
    stride *= count;
  }
  find_end();
}

void CellWalk::find_end() { end_ = std::clamp(std::min({next_[0], next_[1], next_[2]}), begin_, last_); }

bool CellWalk::advance() {
  if (!(end_ < last_)) return false;
  const std::size_t a = next_[0] <= next_[1] ? (next_[0] <= next_[2] ? 0 : 2) : next_[1] <= next_[2] ? 1 : 2;
  cell_ = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell_) + stride_[a]);
  next_[a] = --left_[a] > 0 ? next_[a] + step_[a] : no_plane;
  begin_ = end_;
  find_end();
  return true;
}

}  // namespace vitrail
