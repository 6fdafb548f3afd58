// SPDX-License-Identifier: Apache-2.0
// This file has points of whole spheres that emit, for any number of lanes: QuadricLight takes one lane of
// it.
#pragma once

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local_lanes.h"
#include "tracer/quadrics/placed_quadric.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

// It says how the unit sphere is seen from q.
template <class D>
struct SphereCone {
  D d2;  // |q|²
  Mask<D> outside;
  D height;  // 1 − cos θ of the cone; 2: all directions
};
// `doubt` is the error of |q|² where q is on the sphere.
template <class D>
VITRAIL_LANES SphereCone<D> sphere_cone(Vector<D> q, std::type_identity_t<D> doubt) {
  SphereCone<D> cone;
  cone.d2 = dot(q, q);
  cone.outside = cone.d2 > 1.0 + doubt;
  // (1 − cos θ)(1 + cos θ) = sin² θ = 1/|q|².
  const D seen = 1.0 / (cone.d2 * (1.0 + lanes::sqrt((cone.d2 - 1.0) / cone.d2)));
  cone.height = select<D>(cone.outside, seen, fill<D>(2));
  return cone;
}
// Returns the density of what is seen from outside, or inside, per solid angle of the own space.
template <class D>
VITRAIL_LANES D cone_pdf(const SphereCone<D>& cone) {
  return 1.0 / (2 * pi * cone.height);
}

template <class D>
struct SphereSample {
  Mask<D> arrives;  // the rest means nothing where not
  Mask<D> outside;  // it is seen from there
  Vector<D> local, to_light, normal;
  D distance, pdf;  // > 0 where it arrives; per solid angle
};

// Samples a sphere that is seen from `from`; sphere(j) is the PlacedQuadric of lane j.
template <class D, class SphereOf>
VITRAIL_LANES SphereSample<D> sample_sphere(Vector<D> from, FloatsLike<D> u, FloatsLike<D> v,
                                            const SphereOf& sphere) {
  const auto vector = [&](const auto& get) __attribute__((always_inline)) { return gather_vector<D>(get); };
#define VITRAIL_OF_SPHERE(member) \
  vector([&](int j) __attribute__((always_inline))->const Vector3d& { return sphere(j).member; })
  const Vector<D> away = from - VITRAIL_OF_SPHERE(origin);
  const Vector<D> q{dot(VITRAIL_OF_SPHERE(inverse[0]), away), dot(VITRAIL_OF_SPHERE(inverse[1]), away),
                    dot(VITRAIL_OF_SPHERE(inverse[2]), away)};
  const SphereCone<D> cone =
      sphere_cone(q, gather<D>([&](int j) __attribute__((always_inline)) { return sphere(j).doubt; }));
  // It is a point of the disk, lifted onto the cap of that height: equal areas stay equal.
  const Vector<D> disk = sample_cosine_hemisphere(u, v);
  const D r2 = disk.x * disk.x + disk.y * disk.y;
  const D drop = cone.height * r2;
  const D aside = lanes::sqrt(cone.height * (2.0 - drop));
  const Vector<D> cap{disk.x * aside, disk.y * aside, 1.0 - drop};

  SphereSample<D> s;
  s.outside = cone.outside;
  const D d = lanes::sqrt(cone.d2);
  const Frame<D> frame = frame_of(q * (-1.0 / d));
  // It is the sine of the angle between the ray and the normal where they meet, over the radius of `cap`.
  const D sine = aside * d, cosine = safe_sqrt(1.0 - sine * sine * r2);
  const D turned = sine * cap.z - cosine * aside;  // sin of the angle at the centre, likewise
  Vector<D> direction = frame.to_world(cap);
  Vector<D> normal = frame.to_world({disk.x * turned, disk.y * turned, fill<D>(0)}) -
                     frame.normal * (cosine * cap.z + aside * sine * r2);
  D t = (cone.d2 - 1.0) / (d * cap.z + cosine);
  Mask<D> meets = cone.outside;
  if (!all(cone.outside)) {
    const D b = dot(q, cap), inside = b * b + 1.0 - cone.d2;
    const D t_inside = safe_sqrt(inside) - b;
    direction = select<D>(cone.outside, direction, cap);
    normal = select<D>(cone.outside, normal, q + cap * t_inside);
    t = select<D>(cone.outside, t, t_inside);
    meets = cone.outside | (inside >= 0);
  }
  const Vector<D> unit = normalize(normal);
  s.local = {0.0 + unit.x, 0.0 + unit.y, 0.0 + unit.z};
  const Vector<D> way = VITRAIL_OF_SPHERE(column[0]) * direction.x +
                        VITRAIL_OF_SPHERE(column[1]) * direction.y +
                        VITRAIL_OF_SPHERE(column[2]) * direction.z;
  const D longer = length(way);
  s.to_light = way * (1.0 / longer);
  s.distance = t * longer;
  const Vector<D> across = VITRAIL_OF_SPHERE(cofactor[0]) * s.local.x +
                           VITRAIL_OF_SPHERE(cofactor[1]) * s.local.y +
                           VITRAIL_OF_SPHERE(cofactor[2]) * s.local.z;
  const Vector<D> upright = normalize(across);
  const Mask<D> is_turned =
      gather_mask<D>([&](int j) __attribute__((always_inline)) { return sphere(j).is_turned; });
  s.normal = select<D>(is_turned, -upright, upright);
  s.pdf = cone_pdf(cone) * longer * longer * longer /
          gather<D>([&](int j) __attribute__((always_inline)) { return sphere(j).determinant; });
#undef VITRAIL_OF_SPHERE
  s.arrives = meets & (s.distance > 0) & (s.pdf > 0);
  return s;
}

}  // namespace
}  // namespace vitrail::lanes
