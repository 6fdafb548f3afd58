// SPDX-License-Identifier: Apache-2.0
// This file draws points on triangles that emit, in lanes. It has draw_triangle for lights that shine to all
// directions, alike all over the triangle or by a texture without TriangleParts. The caller finds what the
// points radiate. Directional lights, parts and quadrics are left to sample_light.
#pragma once

#include "tracer/lights/light_sampler.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

template <class D>
struct Place {
  D b1, b2;
};
// Returns a uniform place on a triangle, as vitrail::uniform_place.
template <class F>
VITRAIL_LANES Place<DoublesLike<F>> uniform_place(F u, F v) {
  using D = DoublesLike<F>;
  const D b1 = to_doubles(u) / 2.0, b2 = to_doubles(v) / 2.0, offset = b2 - b1;
  return {b1 - lanes::min(offset, fill<D>(0)), b2 + lanes::max(offset, fill<D>(0))};
}

template <class D>
struct LampSample {
  Mask<D> arrives;  // the rest means nothing where not
  Vector<D> to_light, normal;
  D distance, tilt_rad;
  D pdf;  // solid angle, given the light
  Place<D> place;
};

// slot(j) and face(j) are of the triangle of lane j, and two_sided(j) of its light.
template <class D, class SlotOf, class FaceOf, class TwoSided>
VITRAIL_LANES LampSample<D> draw_triangle(Vector<D> p, FloatsLike<D> u, FloatsLike<D> v, const SlotOf& slot,
                                          const FaceOf& face, const TwoSided& two_sided) {
  const auto corner = [&](std::size_t k) __attribute__((always_inline)) {
    return to_doubles(gather_vector<FloatsLike<D>>([&](int j) __attribute__((always_inline))->const Point3f& {
      return slot(j).p[k];
    }));
  };
  LampSample<D> sample;
  sample.place = uniform_place(u, v);
  const Vector<D> p0 = corner(0), e1 = corner(1) - p0, e2 = corner(2) - p0;
  sample.normal =
      gather_vector<D>([&](int j) __attribute__((always_inline))->const Vector3d& { return face(j).normal; });
  const D area = gather<D>([&](int j) __attribute__((always_inline)) { return face(j).area; });
  const Vector<D> towards = (p0 + e1 * sample.place.b1 + e2 * sample.place.b2) - p;
  const D distance2 = dot(towards, towards);
  sample.distance = lanes::sqrt(distance2);
  sample.to_light = towards * (1.0 / sample.distance);
  const D cosine = -dot(sample.to_light, sample.normal);
  sample.arrives = (distance2 > 0) & ((cosine > 0) | ((cosine < 0) & gather_mask<D>(two_sided)));
  sample.tilt_rad = gather<D>([&](int j) __attribute__((always_inline)) { return face(j).tilt_rad; });
  sample.pdf = distance2 / (abs(cosine) * area);
  return sample;
}

}  // namespace
}  // namespace vitrail::lanes
