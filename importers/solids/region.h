// SPDX-License-Identifier: Apache-2.0
// Contours enclose regions in the plane, and solids are swept of these.
#pragma once

#include <span>
#include <vector>

#include "importers/solids/solid.h"
#include "importers/solids/spline.h"

namespace vitrail::solids {

// It says which points contours enclose: `even_odd` those with an odd number of crossings on the way to
// infinity, `non_zero` those around which the contours turn.
enum class FillRule { even_odd, non_zero };

// It is a boundary edge with what it encloses on its left, and the tangents of the contour at both ends.
struct RegionEdge {
  std::uint32_t from, to;
  Point2d tangent_from, tangent_to;
};

struct Region {
  std::vector<Point2d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise
  std::vector<RegionEdge> edges;
};

// Finds the region by a constrained Delaunay triangulation. Contours may cross themselves and each other.
Region region_of(std::span<const PlaneCurve> contours, FillRule rule);

// Sweeps a region from z = low, where (x,y) are multiplied by scale_low, to z = high > low. A scale may be 0:
// a point; the two have no different signs. Caps get the surface `cap`.
Solid swept(const Region& region, double low, double scale_low, double high, double scale_high,
            std::uint32_t cap);

}  // namespace vitrail::solids
