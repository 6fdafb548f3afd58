// SPDX-License-Identifier: Apache-2.0
// This file bounds a medium's extinction from place to place. A coarse grid over the medium has in each cell
// the least and the greatest extinction there. A walk along a ray goes from cell to cell (Amanatides and Woo,
// "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987). Null collisions are thus as many as the greatest
// extinction near the ray requires, not the greatest of all.
#pragma once

#include <array>
#include <vector>

#include "scene/records/medium.h"

namespace vitrail {

// It holds for every point of a cell and every wavelength:
// constants_low·k + grids_low ≤ σ_t ≤ constants_high·k + grids_high. k is the sum of the coefficients of the
// medium that are the same everywhere.
struct ExtinctionRange {
  float constants_low = 0, constants_high = 0, grids_low = 0, grids_high = 0;
};

struct ExtinctionGrid {
  Bounds3d bounds;  // in the medium's space; empty: the only cell has no end
  std::array<int, 3> cells{1, 1, 1};
  std::vector<ExtinctionRange> ranges;  // x fastest
};

// `bounds` holds the medium, in its space; it is empty where the medium has no end. The function takes the
// time of reading the medium's grids once.
ExtinctionGrid bound_extinction(const Medium& medium, const Bounds3d& bounds);

// A CellWalk visits the cells along p + t·d for first ≤ t ≤ last, in order. They follow each other without a
// gap, and the last of them ends at `last`.
class CellWalk {
 public:
  // first ≤ last; p and d are in the medium's space.
  CellWalk(const ExtinctionGrid& grid, Point3d p, Vector3d d, double first, double last);

  const ExtinctionRange& range() const { return grid_.ranges[cell_]; }
  double begin() const { return begin_; }
  double end() const { return end_; }
  // Returns false behind the last cell.
  bool advance();

 private:
  void find_end();

  const ExtinctionGrid& grid_;
  double begin_, end_, last_;
  std::size_t cell_ = 0;
  // They are by axis. next_ is t of the next plane between cells, ∞ where there is none; step_ is t from
  // plane to plane. left_ counts the cells that remain before the grid ends; stride_ is what a step adds to
  // the index.
  std::array<double, 3> next_, step_;
  std::array<int, 3> left_;
  std::array<std::ptrdiff_t, 3> stride_;
};

}  // namespace vitrail
