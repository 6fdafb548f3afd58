// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/warp.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"

namespace vitrail {

namespace {

// A cell of a grid of nodes, and where in it: in [0, 1].
struct Cell {
  std::size_t row, column;
  double x, y;
};

Cell cell_at(std::size_t rows, std::size_t columns, Point2d p) {
  const double x = std::clamp(p.x, 0.0, 1.0) * static_cast<double>(columns - 1),
               y = std::clamp(p.y, 0.0, 1.0) * static_cast<double>(rows - 1);
  const std::size_t column = std::min(static_cast<std::size_t>(x), columns - 2),
                    row = std::min(static_cast<std::size_t>(y), rows - 2);
  return {row, column, x - static_cast<double>(column), y - static_cast<double>(row)};
}

double cells(const Warp& w) { return static_cast<double>(w.rows - 1) * static_cast<double>(w.columns - 1); }

double mix(double a, double b, double t) { return a + (b - a) * t; }

// A number of a table that has `stride` of them for each slice.
double blended(const std::vector<float>& table, const Slices& s, std::size_t stride, std::size_t at) {
  double sum = 0;
  for (std::size_t i = 0; i < s.count; ++i)
    sum += s.weight[i] * static_cast<double>(table[s.index[i] * stride + at]);
  return sum;
}

struct Blend {
  const Warp& warp;
  const Slices& slices;
  double density(std::size_t row, std::size_t column) const {
    return blended(warp.density, slices, warp.rows * warp.columns, row * warp.columns + column);
  }
  double along(std::size_t row, std::size_t column) const {
    return blended(warp.along, slices, warp.rows * warp.columns, row * warp.columns + column);
  }
  double all_along(std::size_t row) const { return along(row, warp.columns - 1); }
  double up_to(std::size_t row) const { return blended(warp.up_to, slices, warp.rows, row); }
};

// ∫ up to t of a density that goes from a to b over an interval of 1, and where that is `area`.
double area_up_to(double a, double b, double t) { return t * (a + 0.5 * (b - a) * t); }
double where_area_is(double a, double b, double area) {
  const double root = a + safe_sqrt(a * a + 2 * area * (b - a));
  return root > 0 ? std::clamp(2 * area / root, 0.0, 1.0) : 0;
}

// The last i < count − 1 with f(i) ≤ x, f ascending from 0.
template <class F>
std::size_t last_not_above(std::size_t count, double x, const F& f) {
  std::size_t low = 0, high = count - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (f(middle) <= x ? low : high) = middle;
  }
  return low;
}

double density_in(const Blend& of, const Cell& c) {
  return mix(mix(of.density(c.row, c.column), of.density(c.row, c.column + 1), c.x),
             mix(of.density(c.row + 1, c.column), of.density(c.row + 1, c.column + 1), c.x), c.y);
}

}  // namespace

Warp make_warp(const SquareTable& table) {
  Warp w{table.rows, table.columns, table.values, {}, {}};
  const std::size_t square = w.rows * w.columns;
  w.along.resize(table.values.size());
  w.up_to.resize(table.values.size() / w.columns);
  for (std::size_t slice = 0; slice < table.values.size() / square; ++slice) {
    float* const density = &w.density[slice * square];
    std::vector<double> along(square), up_to(w.rows);
    for (std::size_t i = 0; i < square; ++i)
      if (i % w.columns > 0)
        along[i] =
            along[i - 1] + 0.5 * (static_cast<double>(density[i - 1]) + static_cast<double>(density[i]));
    for (std::size_t row = 1; row < w.rows; ++row)
      up_to[row] = up_to[row - 1] + 0.5 * (along[row * w.columns - 1] + along[(row + 1) * w.columns - 1]);
    const double norm = 1 / up_to.back();  // > 0: fault_of
    for (std::size_t i = 0; i < square; ++i) {
      density[i] = static_cast<float>(static_cast<double>(density[i]) * norm);
      w.along[slice * square + i] = static_cast<float>(along[i] * norm);
    }
    for (std::size_t row = 0; row < w.rows; ++row)
      w.up_to[slice * w.rows + row] = static_cast<float>(up_to[row] * norm);
  }
  return w;
}

WarpPoint sample(const Warp& w, const Slices& slices, Point2d u) {
  const Blend of{w, slices};
  Cell c{};
  c.row = last_not_above(w.rows, u.y, [&](std::size_t row) { return of.up_to(row); });
  const double row0 = of.all_along(c.row), row1 = of.all_along(c.row + 1);
  c.y = where_area_is(row0, row1, u.y - of.up_to(c.row));
  const double target = u.x * mix(row0, row1, c.y);
  const auto along = [&](std::size_t i) { return mix(of.along(c.row, i), of.along(c.row + 1, i), c.y); };
  c.column = last_not_above(w.columns, target, along);
  const double left = mix(of.density(c.row, c.column), of.density(c.row + 1, c.column), c.y),
               right = mix(of.density(c.row, c.column + 1), of.density(c.row + 1, c.column + 1), c.y);
  c.x = where_area_is(left, right, target - along(c.column));
  return {{(static_cast<double>(c.column) + c.x) / static_cast<double>(w.columns - 1),
           (static_cast<double>(c.row) + c.y) / static_cast<double>(w.rows - 1)},
          mix(left, right, c.x) * cells(w)};
}

WarpPoint inverse(const Warp& w, const Slices& slices, Point2d p) {
  const Blend of{w, slices};
  const Cell c = cell_at(w.rows, w.columns, p);
  const double row0 = of.all_along(c.row), row1 = of.all_along(c.row + 1), all = mix(row0, row1, c.y);
  const double left = mix(of.density(c.row, c.column), of.density(c.row + 1, c.column), c.y),
               right = mix(of.density(c.row, c.column + 1), of.density(c.row + 1, c.column + 1), c.y);
  const double along =
      mix(of.along(c.row, c.column), of.along(c.row + 1, c.column), c.y) + area_up_to(left, right, c.x);
  return {{all > 0 ? along / all : 0, of.up_to(c.row) + area_up_to(row0, row1, c.y)},
          mix(left, right, c.x) * cells(w)};
}

double density(const Warp& w, const Slices& slices, Point2d p) {
  return density_in({w, slices}, cell_at(w.rows, w.columns, p)) * cells(w);
}

double bilinear(const SquareTable& t, std::size_t slice, Point2d p) {
  const Cell c = cell_at(t.rows, t.columns, p);
  const float* const v = &t.values[slice * t.rows * t.columns + c.row * t.columns + c.column];
  const auto at = [&](std::size_t i) { return static_cast<double>(v[i]); };
  return mix(mix(at(0), at(1), c.x), mix(at(t.columns), at(t.columns + 1), c.x), c.y);
}

}  // namespace vitrail
