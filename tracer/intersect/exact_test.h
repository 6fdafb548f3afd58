// SPDX-License-Identifier: Apache-2.0
// The test that decides every hit. It is compiled once, without FMA, and used by all kernels and traversals.
#pragma once

#include "tracer/intersect/ray.h"

namespace vitrail {

// t of the ray's hit with one triangle of a cluster, and its barycentrics.
struct ExactHit {
  double t, u, v;
};

// A pure function of the ray and three vertices, in double: shears the vertices so that the ray runs along z,
// and takes the signs of the three edge functions (Woop, Benthin & Wald, JCGT 2(1), 2013). False where t ≤ 0,
// where the triangle is seen too nearly edge-on for t to be known, and for an empty lane. `exclude` is the
// caller's business.
bool exact_hit(const RayConstants& ray, const Cluster& cluster, unsigned lane, ExactHit& hit);

}  // namespace vitrail
