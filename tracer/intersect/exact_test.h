// SPDX-License-Identifier: Apache-2.0
// The test that decides every hit. It is compiled once, without FMA, and used by all kernels and traversals.
#pragma once

#include "tracer/rays/ray.h"

namespace vitrail {

// t of the ray's hit with one triangle of a cluster, and its barycentrics.
struct ExactHit {
  double t, u, v;
  bool front;  // the ray comes from the triangle's front side
};

// A pure function of the ray and three vertices, in double: shears the vertices so that the ray runs along z,
// and takes the signs of the three edge functions (Woop, Benthin & Wald, JCGT 2(1), 2013). False where t ≤ 0,
// where the triangle is seen too nearly edge-on for t to be known, and for an empty lane. `exclude` is the
// caller's business. The order of the vertices decides `front` alone: t has the same bits for all six.
bool exact_hit(const RayConstants& ray, const Cluster& cluster, unsigned lane, ExactHit& hit);

// Of surfaces in one place the ray sees the one that faces it: what turns its back counts as farther by so
// much, which is more than floats part two surfaces by that were to be in one place, of coordinates up to
// `reach` and at most as far away as the ray's way and its origin. t is never less than the distance, so
// nothing that culls by it has to know.
double setback(const RayConstants& ray, double t, double reach);

// The exact test with that t: what hits and shadows go by.
bool seen_hit(const RayConstants& ray, const Cluster& cluster, unsigned lane, ExactHit& hit);

}  // namespace vitrail
