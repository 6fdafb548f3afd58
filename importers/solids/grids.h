// SPDX-License-Identifier: Apache-2.0
// These surfaces lie over a rectangle of parameters.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "importers/solids/implicit.h"

namespace vitrail::solids {

// It is POV-Ray's height field in the unit cube, y up.
struct HeightField {
  int columns = 0, rows = 0;    // at least 2 each, along x and along z
  std::vector<double> heights;  // 0 … 1, a row of x after the other, from z = 0 (an image's last row) on
  double water_level = 0;       // what is below is not there
  bool smooth = false;          // normals of central differences, else of the triangles
  bool closed = true;           // with `unseen` sides and bottom, for CSG; else the top alone
};
Solid height_field(const HeightField& field);

// Makes a Bézier patch of 4 × 4 points, a row of u after the other. It is not closed. Its front is where ∂u ×
// ∂v points.
Solid bicubic_patch(const std::array<Point3d, 16>& points, const Tessellation& tessellation = {});

// It gives places by (u,v). The surface is not closed, and is cut where it leaves the container.
struct Parametric {
  std::function<Point3d(double u, double v)> place;
  std::array<double, 2> from{0, 0}, to{1, 1};
  std::optional<Container> contained_by;
};
Solid parametric(const Parametric& parametric, const Tessellation& tessellation = {});

}  // namespace vitrail::solids
