// SPDX-License-Identifier: Apache-2.0
// This file has a ray in the space of an object that a chain of instances led to. It only culls: boxes of the
// object are widened by the rounding of the transform. It is compiled once, for all kernels.
// docs/why/exact-intersection.md has the bounds.
#pragma once

#include "bundle/instance.h"
#include "bundle/oriented_quadric.h"
#include "bundle/triangle_number.h"
#include "tracer/quadrics/quadric_hits.h"
#include "tracer/rays/ray.h"

namespace vitrail {

// Returns the matrix of a chain of instances that `ref` extends to `object`, as it is at a time. `outer` is
// the chain's matrix; it is null where `ref` is the first of the chain.
Affine through_instance(const Affine* outer, const InstanceRef& ref, const DomainView& object, double time_s);

// It has no initialisers: the kernels must not instantiate a constructor.
struct InstanceRay {
  const DomainView* domain;  // has the objects
  // They are of what the chain led to: an object, or the domain itself. Trees are null where there are none.
  const BvhNode* nodes;
  const Cluster* clusters;
  const BvhNode* instance_nodes;
  const InstanceRef* instances;

  // They describe the chain.
  Affine to_bundle;
  bool mirrored;
  std::uint32_t first_triangle;
  std::uint32_t depth;
  std::uint32_t chain[max_instance_depth];

  // The points are origin + s·direction, s = (ζ − entry)·unit ≥ 0; the greatest component of the direction is
  // ±1. A point of the true ray lies within `pad` of this one on each axis. In the domain itself `origin` and
  // the members after it are unset until an instance is entered: most rays meet none.
  bool has_origin;
  double entry, unit;
  double exit;  // ζ where the ray leaves the instance
  double origin[3], inverse_direction[3], pad[3];
};

// Sets `ray` to the ray in the domain itself, which has instances: its chain is empty.
void enter_domain(const DomainView& domain, InstanceRay& ray);

// Returns whether instance `index` at the place of `outer` is a quadric.
inline bool is_quadric(const InstanceRay& outer, std::uint32_t index) {
  return outer.domain->objects[outer.instances[index].object]->quadric != nullptr;
}
// Returns the t that hits and shadows go by: it is `seen_hit` for quadrics. Curves are never seen from
// within.
double seen_t(const RayConstants& ray, const Affine& to_bundle, const OrientedQuadric& quadric,
              const QuadricHit& hit);
// They return whether the quadric lowers the hit, and whether it blocks the ray.
bool closest_in_quadric(const RayConstants& ray, const InstanceRay& outer, std::uint32_t index, Hit& hit);
bool occluded_in_quadric(const RayConstants& ray, const InstanceRay& outer, std::uint32_t index, float tmax);

// Sets `inner` to the ray in instance `index` at the place of `outer`. Returns false where the ray misses the
// instance's box at ζ ≤ limit, or where the chain is too long.
bool enter_instance(const RayConstants& ray, InstanceRay& outer, std::uint32_t index, float limit,
                    InstanceRay& inner);

}  // namespace vitrail
