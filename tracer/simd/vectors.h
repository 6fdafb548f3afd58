// SPDX-License-Identifier: Apache-2.0
// This file has points, directions and spectra of W paths, each coordinate in lanes, with the operations of
// scene/geometry/vec.h.
#pragma once

#include "scene/geometry/vec.h"
#include "scene/spectra/sampled_spectrum.h"
#include "tracer/simd/lanes.h"

namespace vitrail::lanes {
namespace {

template <class D>
struct Vector {
  D x, y, z;
};

// clang-format off
template <class D> VITRAIL_LANES Vector<D> operator+(Vector<D> a, Vector<D> b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class D> VITRAIL_LANES Vector<D> operator-(Vector<D> a, Vector<D> b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class D> VITRAIL_LANES Vector<D> operator-(Vector<D> a) { return {-a.x, -a.y, -a.z}; }
template <class D> VITRAIL_LANES Vector<D> operator*(Vector<D> a, std::type_identity_t<D> s) { return {a.x * s, a.y * s, a.z * s}; }

template <class D> VITRAIL_LANES D dot(Vector<D> a, Vector<D> b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class D> VITRAIL_LANES Vector<D> cross(Vector<D> a, Vector<D> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class D> VITRAIL_LANES D length(Vector<D> v) { return lanes::sqrt(dot(v, v)); }
// clang-format on

template <class D>
VITRAIL_LANES Vector<D> fill(Vector3d v) {
  return {fill<D>(v.x), fill<D>(v.y), fill<D>(v.z)};
}
template <class D>
VITRAIL_LANES Vector<D> select(std::type_identity_t<Mask<D>> mask, Vector<D> a, Vector<D> b) {
  return {select<D>(mask, a.x, b.x), select<D>(mask, a.y, b.y), select<D>(mask, a.z, b.z)};
}
template <class F>
VITRAIL_LANES Vector<DoublesLike<F>> to_doubles(Vector<F> v) {
  return {convert<double>(v.x), convert<double>(v.y), convert<double>(v.z)};
}
template <class D>
VITRAIL_LANES Vector<FloatsLike<D>> to_floats(Vector<D> v) {
  return {convert<float>(v.x), convert<float>(v.y), convert<float>(v.z)};
}

// Returns get(j).x, .y, .z of each lane j: a Vector3 or Point3 of any number.
template <class D, class Get>
VITRAIL_LANES Vector<D> gather_vector(const Get& get) {
  return {gather<D>([&](int j) __attribute__((always_inline)) { return get(j).x; }),
          gather<D>([&](int j) __attribute__((always_inline)) { return get(j).y; }),
          gather<D>([&](int j) __attribute__((always_inline)) { return get(j).z; })};
}
// Returns the vector of one lane.
template <class D>
VITRAIL_LANES Vector3<Number<D>> lane(const Vector<D>& v, int j) {
  return {lane(v.x, j), lane(v.y, j), lane(v.z, j)};
}

template <class D>
VITRAIL_LANES void set_lane(Vector<D>& v, int j, const Vector3<Number<D>>& x) {
  set_lane(v.x, j, x.x);
  set_lane(v.y, j, x.y);
  set_lane(v.z, j, x.z);
}

// Returns a unit vector; v itself where its length is zero or not finite.
template <class D>
VITRAIL_LANES Vector<D> normalize(Vector<D> v) {
  const D l = length(v);
  const Mask<D> usable = (l > 0) & (l <= std::numeric_limits<double>::max());
  return select<D>(usable, v * (1.0 / l), v);
}

// They are four values a path: random numbers, or values at its wavelengths.
template <class F>
struct Four {
  F v[4];
  VITRAIL_LANES F& operator[](int i) { return v[i]; }
  VITRAIL_LANES const F& operator[](int i) const { return v[i]; }
};
// Returns the same in all lanes.
template <class F>
VITRAIL_LANES Four<F> fill(const SampledSpectrum& s) {
  return {{fill<F>(s.v[0]), fill<F>(s.v[1]), fill<F>(s.v[2]), fill<F>(s.v[3])}};
}
// Returns the spectrum of one lane.
template <class F>
VITRAIL_LANES SampledSpectrum lane(const Four<F>& s, int j) {
  return {{lane(s[0], j), lane(s[1], j), lane(s[2], j), lane(s[3], j)}};
}

template <class F>
VITRAIL_LANES F greatest(const Four<F>& s) {
  return lanes::max(lanes::max(lanes::max(s[0], s[1]), s[2]), s[3]);
}

// It is ShadingFrame.
template <class D>
struct Frame {
  Vector<D> tangent, bitangent, normal;
  VITRAIL_LANES Vector<D> to_world(Vector<D> v) const {
    return tangent * v.x + bitangent * v.y + normal * v.z;
  }
  VITRAIL_LANES Vector<D> to_local(Vector<D> v) const {
    return {dot(v, tangent), dot(v, bitangent), dot(v, normal)};
  }
};

// It is Frame of scene/geometry/frame.h.
template <class D>
VITRAIL_LANES Frame<D> frame_of(Vector<D> n) {
  const D sign = sign_of(n.z), a = -1.0 / (sign + n.z), b = n.x * n.y * a;
  return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

// Returns the shading frame of a surface: its tangent follows `along`, where that has a part across n. `side`
// is −1 where the surface scatters on its back as in front, which turns the normal alone.
template <class D>
VITRAIL_LANES Frame<D> frame_around(Vector<D> n, Vector<D> along, D side) {
  Frame<D> frame = frame_of(n);
  const Vector<D> across = along - n * dot(n, along);
  const Mask<D> use = dot(across, across) > 1e-12 * dot(along, along);
  if (any(use)) {
    const Vector<D> tangent = normalize(across);
    frame.bitangent = select<D>(use, cross(n, tangent), frame.bitangent);
    frame.tangent = select<D>(use, tangent, frame.tangent);
  }
  frame.normal = n * side;
  return frame;
}

}  // namespace
}  // namespace vitrail::lanes
