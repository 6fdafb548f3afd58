// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail {

using CornerTriple = std::array<std::uint32_t, 3>;

// Cuts a simple polygon in space into corners.size() − 2 triangles of its corners, appended to `triangles` as
// indices into `corners` and oriented like the polygon. A polygon that the fan (0,1,2), (0,2,3) … tiles gets
// that fan, others (concave) have ears clipped in the projection along their normal (Newell's). Polygons that
// cross themselves get some triangulation. There are at least three corners. It takes O(n) for fans,
// otherwise about O(n log n) for n corners, for the strangest shapes O(n √n).
void triangulate_polygon(std::span<const Point3d> corners, std::vector<CornerTriple>& triangles);

}  // namespace vitrail
