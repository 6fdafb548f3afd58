// SPDX-License-Identifier: Apache-2.0
// This file finds where lines meet quadrics, for any number of lanes: quadric_hits takes one lane of it.
#pragma once

#include "tracer/quadrics/placed_quadric.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

// It is a·s² + 2b·s + c of a whole surface at p + s·d.
template <class D>
struct Quadratic {
  D a, b, c;
};
template <class D>
VITRAIL_LANES Quadratic<D> sphere_quadratic(Vector<D> p, Vector<D> d) {
  return {dot(d, d), dot(p, d), dot(p, p) - 1.0};
}

// It is the line o + t·d from the point that is nearest to the middle, at t = `nearest`.
template <class D>
struct NearestPoint {
  D nearest;
  Vector<D> p;
};
template <class D>
VITRAIL_LANES NearestPoint<D> nearest_point(Vector<D> origin, Vector<D> direction) {
  const D nearest = -dot(origin, direction) / dot(direction, direction);
  return {nearest, origin + direction * nearest};
}

// They are the two ends of the part of a line within the surface, ascending.
template <class D>
struct Crossing {
  D s, t;          // from the nearest point, from the ray's origin
  Mask<D> is_hit;  // t is finite and > 0, and no ray starts there
};
template <class D>
struct Crossings {
  Crossing<D> first, second;
};

// `starts_there` is that of quadric_hits.
template <class D>
VITRAIL_LANES Crossings<D> crossings(Quadratic<D> f, D nearest, std::type_identity_t<Mask<D>> starts_there) {
  const D discriminant = f.b * f.b - f.a * f.c;
  const Mask<D> meets = discriminant >= 0;
  const D root = lanes::sqrt(select<D>(meets, discriminant, fill<D>(0)));
  const D q = -(f.b + sign_of(f.b) * root);
  const Mask<D> has_one = q != 0, has_other = f.a != 0, has_both = has_one & has_other;
  const D one = f.c / q, other = q / f.a;
  const Mask<D> swaps = has_both & (other < one), only_other = no(has_one) | swaps;
  Crossings<D> of;
  of.first.s = select<D>(only_other, other, one);
  of.second.s = select<D>(swaps, one, other);
  of.first.t = nearest + of.first.s;
  of.second.t = nearest + of.second.s;
  constexpr double most = std::numeric_limits<double>::max();
  const Mask<D> starts_second = has_both & (abs(of.second.t) < abs(of.first.t));
  of.first.is_hit = meets & (has_one | has_other) & no(starts_there & no(starts_second)) & (of.first.t > 0) &
                    (of.first.t <= most);
  of.second.is_hit =
      meets & has_both & no(starts_there & starts_second) & (of.second.t > 0) & (of.second.t <= most);
  return of;
}

// Returns the direction as RayConstants has it, which divides by its greatest component.
template <class F>
VITRAIL_LANES Vector<DoublesLike<F>> sheared_direction(Vector<F> direction) {
  using D = DoublesLike<F>;
  const Vector<D> d = to_doubles(direction);
  const D x = abs(d.x), y = abs(d.y), z = abs(d.z);
  const D greatest = select<D>(lanes::max(x, y) > z, select<D>(x > y, d.x, d.y), d.z);
  return {d.x / greatest * greatest, d.y / greatest * greatest, d.z / greatest * greatest};
}

// It is vitrail::quadric_hits for whole spheres; sphere(j) is the PlacedQuadric of lane j.
template <class F, class SphereOf>
VITRAIL_LANES Crossings<DoublesLike<F>> sphere_crossings(Vector<F> origin, Vector<F> direction,
                                                         const SphereOf& sphere,
                                                         Mask<DoublesLike<F>> starts_there) {
  using D = DoublesLike<F>;
  const Vector<D> from =
      to_doubles(origin) - gather_vector<D>([&](int j) __attribute__((always_inline))->const Vector3d& {
        return sphere(j).origin;
      });
  const D scale = gather<D>([&](int j) __attribute__((always_inline)) { return sphere(j).scale; });
  const Vector<D> d = sheared_direction(direction);
  const auto local = [&](Vector<D> v) __attribute__((always_inline)) {
    const auto along = [&](int k) __attribute__((always_inline)) {
      return dot(gather_vector<D>([&](int j) __attribute__((always_inline))->const Vector3d& {
                   return sphere(j).cofactor[k];
                 }),
                 v) *
             scale;
    };
    return Vector<D>{along(0), along(1), along(2)};
  };
  const Vector<D> own_direction = local(d);
  const NearestPoint<D> at = nearest_point(local(from), own_direction);
  return crossings(sphere_quadratic(at.p, own_direction), at.nearest, starts_there);
}

}  // namespace
}  // namespace vitrail::lanes
