// SPDX-License-Identifier: Apache-2.0
// This test decides hits of quadrics. It is a pure function of the ray, the quadric and where it stands, in
// double and without FMA. Every kernel and every decomposition thus has the same bits.
#pragma once

#include "bundle/instance.h"
#include "scene/shapes/quadric.h"

namespace vitrail {

struct RayConstants;  // tracer/rays/ray.h

struct QuadricHit {
  double t;
  Point3d local;  // in the quadric's own space, on the surface as far as doubles tell; of a curve, from its
                  // origin
};

// There are at most two, t ascending, all > 0.
struct QuadricHits {
  int count = 0;
  QuadricHit at[2];
};

// `starts_there` says that the ray starts on this quadric. Its line meets the whole surface in two points.
// The one nearer to the ray's origin is then where it starts, and no hit: glass is left on the other side.
QuadricHits quadric_hits(const RayConstants& ray, const Affine& to_bundle, const Quadric& quadric,
                         bool starts_there);

}  // namespace vitrail
