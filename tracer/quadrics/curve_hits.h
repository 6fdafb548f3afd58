// SPDX-License-Identifier: Apache-2.0
// The test that decides hits of curves, and what is at a hit: as for quadrics a pure function of ray and
// record, in double and without FMA. A segment is cut into 2ᵏ equal parts in its parameter, each the convex
// hull of the balls at its ends. What a line has of a hull is one interval by closed forms; those that
// overlap are one, and a ray meets the curve where one begins. docs/why/hair.md has the why.
#pragma once

#include "scene/shapes/curve.h"
#include "tracer/quadrics/quadric_hits.h"
#include "tracer/quadrics/quadric_surface.h"

namespace vitrail {

// At most one; `local` is taken from the curve's origin. `origin` of the ray too.
// `starts_there`: of all the ends of intervals the one nearest to the ray's origin is where it starts, and
// only what lies beyond that interval can be hit.
QuadricHits curve_hits(Vector3d origin, Vector3d direction, const PlacedCurve& curve, bool starts_there);

// `local` on the surface. `along_v`: whether v runs along it, and u around, else the other way.
QuadricPoint curve_point(const PlacedCurve& curve, Point3d local, bool along_v, bool inside_out);

}  // namespace vitrail
