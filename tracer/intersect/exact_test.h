// SPDX-License-Identifier: Apache-2.0
// The exact test decides every hit. It is compiled once, without FMA, and used by all kernels and traversals.
#pragma once

#include "tracer/rays/ray.h"

namespace vitrail {

// It is t of the ray's hit with one triangle of a cluster, and the barycentrics.
struct ExactHit {
  double t, u, v;
  bool front;  // the ray comes from the triangle's front side
};

// Tests a triangle as a pure function of the ray and three vertices, in double. It shears the vertices so
// that the ray runs along z, and takes the signs of three edge functions (Woop, Benthin & Wald, JCGT 2(1),
// 2013). It is false where t ≤ 0, where the triangle is seen too nearly edge-on for t to be known, and for an
// empty lane. The caller has to handle `exclude`. The order of the vertices decides `front` alone: t has the
// same bits for all six.
bool exact_hit(const RayConstants& ray, const Cluster& cluster, unsigned lane, ExactHit& hit);

// Returns how much farther a surface counts that turns its back to the ray. Thus the ray sees the surface
// that faces it, where several are in one place. It exceeds the distance by which floats part two surfaces
// that were to be in one place. Their coordinates are up to `reach`, and at most as far away as the ray's way
// and its origin. t is never less than the distance, so culling by distance need not know.
double setback(const RayConstants& ray, double t, double reach);

// It is the exact test with that t, which hits and shadows go by.
bool seen_hit(const RayConstants& ray, const Cluster& cluster, unsigned lane, ExactHit& hit);

}  // namespace vitrail
