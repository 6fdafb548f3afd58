// SPDX-License-Identifier: Apache-2.0
#include "tracer/intersect/instance_ray.h"

#include <algorithm>
#include <cmath>

#include "bundle/triangle_number.h"
#include "scene/geometry/motion.h"
#include "tracer/intersect/exact_test.h"
#include "tracer/quadrics/quadric_surface.h"

namespace vitrail {

namespace {

double max3(double a, double b, double c) { return std::max(std::max(a, b), c); }

// 1/d, at most 10¹⁸, which moves a ray by 10⁻¹⁸ of its length.
double limited_inverse(double d) { return std::abs(d) * 1e18 > 1 ? 1 / d : std::copysign(1e18, d); }

// d/|d_z| on each axis.
void find_direction(const RayConstants& ray, double d[3]) {
  d[ray.x] = ray.exact_shear_x * static_cast<double>(ray.sign_z);
  d[ray.y] = ray.exact_shear_y * static_cast<double>(ray.sign_z);
  d[ray.z] = static_cast<double>(ray.sign_z);
}

// Where the ray is in the box, in its own s, as far as `limit`. False where it is not.
bool cross_box(const InstanceRay& ray, const InstanceRef& ref, double limit, double& enter, double& leave) {
  enter = 0;
  leave = limit;
  for (int axis = 0; axis < 3; ++axis) {
    const double a =
        (double{ref.lower[axis]} - ray.pad[axis] - ray.origin[axis]) * ray.inverse_direction[axis];
    const double b =
        (double{ref.upper[axis]} + ray.pad[axis] - ray.origin[axis]) * ray.inverse_direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

// Inverse of the 3×3 block, by cofactors. False where there is none.
bool invert(const double m[3][4], double inverse[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
      inverse[i][j] = m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    }
  const double determinant = m[0][0] * inverse[0][0] + m[0][1] * inverse[1][0] + m[0][2] * inverse[2][0];
  const double reciprocal = 1 / determinant;
  if (!std::isfinite(reciprocal)) return false;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inverse[i][j] *= reciprocal;
  return true;
}

double row_sum(const double* row) { return std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]); }

double greatest(const auto v[3]) {
  return max3(std::abs(double{v[0]}), std::abs(double{v[1]}), std::abs(double{v[2]}));
}

// What a point of the true ray may be off in the scene's coordinates: the padding of what the object shows,
// for the rounding of placed vertices and of the exact test; the rounding of the advanced origin, `far` from
// 0; and that of the inverse over the distance `near`, whose relative error grows with the square of the
// condition.
double deviation(double reach, double far, double near, double condition) {
  return padding(reach) + 0x1p-50 * (far + near) + 0x1p-44 * condition * condition * near;
}

// No |coordinate| of what lies within ±reach is greater where m places it.
double placed_reach(const double m[3][4], double reach) {
  const auto of = [&](int axis) { return std::abs(m[axis][3]) + row_sum(m[axis]) * reach; };
  return max3(of(0), of(1), of(2));
}

void show(const DomainView& object, InstanceRay& ray) {
  ray.nodes = object.nodes.empty() ? nullptr : object.nodes.data();
  ray.clusters = object.clusters.data();
  ray.instance_nodes = object.instance_nodes.empty() ? nullptr : object.instance_nodes.data();
  ray.instances = object.instances.data();
}

const Affine* matrix_of(const InstanceRay& ray) { return ray.depth == 0 ? nullptr : &ray.to_bundle; }

// The chain to instance `index`.
void extend_chain(const InstanceRay& outer, std::uint32_t index, double time_s, InstanceRay& inner) {
  const InstanceRef& ref = outer.instances[index];
  const DomainView& object = *outer.domain->objects[ref.object];
  inner.domain = outer.domain;
  show(object, inner);
  inner.to_bundle = through_instance(matrix_of(outer), ref, object, time_s);
  inner.mirrored = mirrors(inner.to_bundle);
  inner.first_triangle = number_from(outer.first_triangle, ref.first_triangle);
  inner.depth = outer.depth + 1;
  std::copy_n(outer.chain, outer.depth, inner.chain);
  inner.chain[outer.depth] = index;
}

}  // namespace

Affine through_instance(const Affine* outer, const InstanceRef& ref, const DomainView& object,
                        double time_s) {
  if (outer && object.quadric) return compose(*outer, object.quadric->quadric, ref.to_parent);
  const Affine to_bundle = outer ? compose(*outer, ref.to_parent) : ref.to_parent;
  return object.motion ? compose(to_bundle, affine(object.motion->at(time_s))) : to_bundle;
}

double seen_t(const RayConstants& ray, const Affine& to_bundle, const OrientedQuadric& quadric,
              const QuadricHit& hit) {
  if (is_curve(quadric.quadric)) return hit.t;
  double d[3];
  find_direction(ray, d);
  const Vector3d normal = placed_quadric_normal(quadric, to_bundle, hit.local);
  if (dot(normal, Vector3d{d[0], d[1], d[2]}) < 0) return hit.t;
  return hit.t + setback(ray, hit.t, placed_reach(to_bundle.m, 1));
}

namespace {

// Of instance `index`, a quadric.
QuadricHits hits_of(const RayConstants& ray, const InstanceRay& outer, std::uint32_t index) {
  const InstanceRef& ref = outer.instances[index];
  const DomainView& object = *outer.domain->objects[ref.object];
  const bool starts_there = number_from(outer.first_triangle, ref.first_triangle) == ray.exclude;
  return quadric_hits(ray, through_instance(matrix_of(outer), ref, object, ray.time_s),
                      object.quadric->quadric, starts_there);
}

double seen_t_of(const RayConstants& ray, const InstanceRay& outer, std::uint32_t index,
                 const QuadricHit& hit) {
  const InstanceRef& ref = outer.instances[index];
  const DomainView& object = *outer.domain->objects[ref.object];
  return seen_t(ray, through_instance(matrix_of(outer), ref, object, ray.time_s), *object.quadric, hit);
}

}  // namespace

bool closest_in_quadric(const RayConstants& ray, const InstanceRay& outer, std::uint32_t index, Hit& hit) {
  const QuadricHits hits = hits_of(ray, outer, index);
  if (hits.count == 0 || outer.depth == max_instance_depth) return false;
  const std::uint32_t id = number_from(outer.first_triangle, outer.instances[index].first_triangle);
  const Point3d local = hits.at[0].local;
  if (!(hits.at[0].t <= hit.t)) return false;
  const double t = seen_t_of(ray, outer, index, hits.at[0]);
  if (!(t < hit.t || (t == hit.t && id < hit.triangle))) return false;
  hit.t = t;
  hit.triangle = id;
  hit.cluster = hit.lane = 0;
  hit.depth = outer.depth + 1;
  hit.u = local.x, hit.v = local.y, hit.w = local.z;
  std::copy_n(outer.chain, outer.depth, hit.chain);
  hit.chain[outer.depth] = index;
  return true;
}

bool occluded_in_quadric(const RayConstants& ray, const InstanceRay& outer, std::uint32_t index, float tmax) {
  const QuadricHits hits = hits_of(ray, outer, index);
  const auto end = static_cast<double>(tmax);
  return hits.count > 0 && hits.at[0].t < end && seen_t_of(ray, outer, index, hits.at[0]) < end;
}

void enter_domain(const DomainView& domain, InstanceRay& ray) {
  ray.domain = &domain;
  show(domain, ray);
  ray.first_triangle = 0;
  ray.depth = 0;
  ray.has_origin = false;
  ray.entry = 0;
  ray.unit = 1;
}

namespace {

void find_origin(const RayConstants& ray, InstanceRay& in_domain) {
  double d[3];
  find_direction(ray, d);
  for (int axis = 0; axis < 3; ++axis) {
    in_domain.origin[axis] = static_cast<double>(ray.origin[axis]);
    in_domain.inverse_direction[axis] = limited_inverse(d[axis]);
    in_domain.pad[axis] = 0x1p-50 * std::abs(in_domain.origin[axis]);
  }
  in_domain.has_origin = true;
}

}  // namespace

bool enter_instance(const RayConstants& ray, InstanceRay& outer, std::uint32_t index, float limit,
                    InstanceRay& inner) {
  if (!outer.has_origin) find_origin(ray, outer);
  double enter, leave;
  if (!cross_box(outer, outer.instances[index], (static_cast<double>(limit) - outer.entry) * outer.unit,
                 enter, leave))
    return false;
  if (outer.depth == max_instance_depth) return false;
  extend_chain(outer, index, ray.time_s, inner);
  inner.entry = outer.entry + enter / outer.unit;
  inner.exit = outer.entry + leave / outer.unit;

  const auto& m = inner.to_bundle.m;
  double to_object[3][3];
  if (!invert(m, to_object)) return false;
  double d[3], relative[3], direction[3];
  find_direction(ray, d);
  for (int axis = 0; axis < 3; ++axis)
    relative[axis] = static_cast<double>(ray.origin[axis]) + inner.entry * d[axis] - m[axis][3];
  const double condition = max3(row_sum(m[0]), row_sum(m[1]), row_sum(m[2])) *
                           max3(row_sum(to_object[0]), row_sum(to_object[1]), row_sum(to_object[2]));
  const double off =
      deviation(placed_reach(m, double{outer.domain->objects[outer.instances[index].object]->reach}),
                greatest(ray.origin) + inner.entry, greatest(relative) + inner.exit - inner.entry, condition);
  for (int axis = 0; axis < 3; ++axis) {
    const double* row = to_object[axis];
    inner.origin[axis] = row[0] * relative[0] + row[1] * relative[1] + row[2] * relative[2];
    direction[axis] = row[0] * d[0] + row[1] * d[1] + row[2] * d[2];
    inner.pad[axis] = row_sum(row) * off;
  }
  inner.has_origin = true;
  inner.unit = greatest(direction);
  for (int axis = 0; axis < 3; ++axis)
    inner.inverse_direction[axis] = limited_inverse(direction[axis] / inner.unit);
  return true;
}

}  // namespace vitrail
