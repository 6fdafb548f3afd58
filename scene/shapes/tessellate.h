// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shapes/mesh.h"

namespace vitrail {

// It is the number of segments of a full turn.
inline constexpr int quadric_segments = 256;

// Returns triangles with exact normals and the quadric's (u,v). Vertices lie on the true surface, so convex
// shapes come out slightly small: with 256 segments, and half as many from pole to pole, points of a sphere
// by up to 1.5e-4 of its radius, its area by 1.3e-4; those of cylinders and disks by 7.5e-5. A part of a turn
// takes the same share of them, rounded up. Where a surface closes on itself (poles, seam), positions agree
// bit for bit.
TriangleMesh tessellate(const Quadric& quadric, int segments = quadric_segments);
// Returns all of them in one mesh. Curves are tubes, each as wide as the curve in the mean of all sides. A
// tube has `segments` corners or, for 0, fewer where there are more curves.
TriangleMesh tessellate(const Quadric& quadric, const QuadricPlaces& places, int segments = 0);

}  // namespace vitrail
