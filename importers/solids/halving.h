// SPDX-License-Identifier: Apache-2.0
// Triangles are halved until they are near enough to the surface that they stand for.
#pragma once

#include <functional>
#include <optional>

#include "importers/solids/solid.h"

namespace vitrail::solids {

// It says on which parts of the surface a triangle lies, in bits that the caller chooses. An edge lies on
// what both of its triangles lie on.
using Lies = std::uint32_t;

// It returns the nearest point of all that a point near it shall lie on; nothing where none is found.
using Projection = std::function<std::optional<Point3d>(const Point3d& p, Lies on)>;

struct Halving {
  double tolerance = 0;
  int rounds = 6;
  std::size_t most_triangles = 4'000'000;
};

// Edges whose middle, and triangles whose centre, are further from their projection than the tolerance are
// halved, in all their triangles: what was closed stays so. `lies` has an entry a triangle. Fills positions
// and triangles; normals are the caller's.
void halve(std::vector<Point3d>& positions, std::vector<std::array<std::uint32_t, 3>>& triangles,
           std::vector<Lies>& lies, const Projection& project, const Halving& halving);

}  // namespace vitrail::solids
