// SPDX-License-Identifier: Apache-2.0
// Bounds of a medium's extinction from place to place: a coarse grid over the medium, each cell with the
// least and the greatest extinction in it, and a walk along a ray from cell to cell (Amanatides and Woo, "A
// Fast Voxel Traversal Algorithm for Ray Tracing", 1987). Null collisions are as many as the greatest
// extinction near the ray asks for, not as the greatest of all.
#pragma once

#include <array>
#include <vector>

#include "scene/records/medium.h"

namespace vitrail {

// For every point of a cell and every wavelength, with k the sum of the coefficients of the medium that are
// the same everywhere:  constants_low·k + grids_low ≤ σ_t ≤ constants_high·k + grids_high.
struct ExtinctionRange {
  float constants_low = 0, constants_high = 0, grids_low = 0, grids_high = 0;
};

struct ExtinctionGrid {
  Bounds3d bounds;  // in the medium's space; empty: the only cell has no end
  std::array<int, 3> cells{1, 1, 1};
  std::vector<ExtinctionRange> ranges;  // x fastest
};

// `bounds`: where the medium is, in its space; empty where it has no end. The time is that of reading its
// grids once.
ExtinctionGrid bound_extinction(const Medium& medium, const Bounds3d& bounds);

// The cells along p + t·d for first ≤ t ≤ last, in order. They follow each other without a gap, and the last
// of them ends at `last`.
class CellWalk {
 public:
  // first ≤ last; p and d are in the medium's space.
  CellWalk(const ExtinctionGrid& grid, Point3d p, Vector3d d, double first, double last);

  const ExtinctionRange& range() const { return grid_.ranges[cell_]; }
  double begin() const { return begin_; }
  double end() const { return end_; }
  // False behind the last cell.
  bool advance();

 private:
  void find_end();

  const ExtinctionGrid& grid_;
  double begin_, end_, last_;
  std::size_t cell_ = 0;
  // By axis: t of the next plane between cells, ∞ where there is none; t from plane to plane; cells that
  // remain before the grid ends; what a step adds to the index.
  std::array<double, 3> next_, step_;
  std::array<int, 3> left_;
  std::array<std::ptrdiff_t, 3> stride_;
};

}  // namespace vitrail
