// SPDX-License-Identifier: Apache-2.0
// A Warp has densities over the unit square that a table holds for each incidence, bilinear between its nodes
// and between incidences. It samples them exactly, by the row first, and inverts the sampling.
#pragma once

#include <array>
#include <vector>

#include "scene/geometry/vec.h"
#include "scene/records/scattering_table.h"

namespace vitrail {

// It says between which squares of a table a place lies, and how much of each counts: linear in each of the
// coordinates.
struct Slices {
  std::array<std::size_t, 4> index{};
  std::array<double, 4> weight{};
  std::size_t count = 0;
  void add(std::size_t i, double w) {
    if (w > 0) index[count] = i, weight[count++] = w;
  }
};

// A Warp is made when its table is loaded: every square is a density of integral 1, with its integrals.
struct Warp {
  std::size_t rows = 0, columns = 0;
  std::vector<float> density;  // [slice][row][column], by the unit of one cell
  std::vector<float> along;    // [slice][row][column]: ∫ along the row up to that column
  std::vector<float> up_to;    // [slice][row]: ∫ over all rows up to that one
};
Warp make_warp(const SquareTable& table);

struct WarpPoint {
  Point2d p;
  double pdf = 0;  // by area of the square, of the place that `p` is warped from or to
};

WarpPoint sample(const Warp& warp, const Slices& slices, Point2d u);
// Returns the u that `sample` takes to p.
WarpPoint inverse(const Warp& warp, const Slices& slices, Point2d p);
double density(const Warp& warp, const Slices& slices, Point2d p);

// Returns the value at p of a square that is no density.
double bilinear(const SquareTable& table, std::size_t slice, Point2d p);

}  // namespace vitrail
