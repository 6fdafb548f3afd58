// SPDX-License-Identifier: Apache-2.0
// This file has the test that decides hits of curves, and the surface at a hit. As for quadrics it is a pure
// function of ray and record, in double and without FMA. A segment is cut into 2ᵏ equal parts in its
// parameter, each the convex hull of the balls at its ends. A line meets a hull in one interval, by closed
// forms. Intervals that overlap are one, and a ray meets the curve where one begins. docs/why/hair.md has the
// reasons.
#pragma once

#include "scene/shapes/curve.h"
#include "tracer/quadrics/quadric_hits.h"
#include "tracer/quadrics/quadric_surface.h"

namespace vitrail {

// Returns at most one hit; `local` is taken from the curve's origin, and so is the ray's `origin`. With
// `starts_there` the end of an interval that is nearest to the ray's origin is where the ray starts. Only
// what lies beyond that interval can then be hit.
QuadricHits curve_hits(Vector3d origin, Vector3d direction, const PlacedCurve& curve, bool starts_there);

// `local` is on the surface. `along_v` says that v runs along the curve, and u around it, else the other way.
QuadricPoint curve_point(const PlacedCurve& curve, Point3d local, bool along_v, bool inside_out);

}  // namespace vitrail
