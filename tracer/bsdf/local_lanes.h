// SPDX-License-Identifier: Apache-2.0
// This file has what local.h declares, for any number of lanes.
#pragma once

#include "scene/geometry/portable_math.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

namespace detail {

// They are portable_math.h's sin_small and cos_small.
template <class D>
VITRAIL_LANES D sin_small(D x) {
  const D x2 = x * x;
  D sum = fill<D>(0);
  for (int k = 17; k >= 3; k -= 2) sum = (1.0 + sum) * (x2 * (-1.0 / (k * (k - 1))));
  return x * (1.0 + sum);
}

template <class D>
VITRAIL_LANES D cos_small(D x) {
  const D x2 = x * x;
  D sum = fill<D>(0);
  for (int k = 18; k >= 2; k -= 2) sum = (1.0 + sum) * (x2 * (-1.0 / (k * (k - 1))));
  return 1.0 + sum;
}

}  // namespace detail

template <class F>
VITRAIL_LANES Vector<DoublesLike<F>> sample_cosine_hemisphere(F u, F v) {
  using D = DoublesLike<F>;
  const D a = 2.0 * to_doubles(u) - 1.0, b = 2.0 * to_doubles(v) - 1.0;
  const Mask<D> middle = (a == 0) & (b == 0), wide = abs(a) > abs(b);
  const D radius = select<D>(wide, a, b);
  const D phi = (pi / 4) * (select<D>(wide, b, a) / select<D>(middle, fill<D>(1), radius));
  const D along = radius * detail::cos_small(phi), across = radius * detail::sin_small(phi);
  const D z = lanes::sqrt(1.0 - radius * radius);
  return select<D>(middle, fill<D>(Vector3d{0, 0, 1}),
                   {select<D>(wide, along, across), select<D>(wide, across, along), z});
}

// The arguments' order lets no NaN of an idle lane reach the conversion.
template <class D>
VITRAIL_LANES D attainable(D p) {
  const D steps = ceil_of_few(lanes::min(fill<D>(1), lanes::max(fill<D>(0), p)) * 0x1p24);
  const D inside = lanes::clamp<D>(steps, 1.0, 0x1p24 - 1) * 0x1p-24;
  return select<D>(p > 0, select<D>(p < 1, inside, fill<D>(1)), fill<D>(0));
}

// It holds two values: s of light whose field is across the plane of incidence, p of light whose field is in
// it.
template <class D>
struct Polarized {
  D s, p;
};
// Returns the share that light of that Q/I = (s − p)/(s + p), in [−1,1], keeps where its components keep
// `parts`.
template <class D>
VITRAIL_LANES D part_of(D q, Polarized<D> parts) {
  return ((1.0 + q) * parts.s + (1.0 - q) * parts.p) / 2.0;
}
// Returns the Q that remains then, for an I of 1 before.
template <class D>
VITRAIL_LANES D polarized_part_of(D q, Polarized<D> parts) {
  return ((1.0 + q) * parts.s - (1.0 - q) * parts.p) / 2.0;
}

// Returns Q/I of light with this Q and I, each rounded by itself.
template <class D>
VITRAIL_LANES D q_of(D polarized, D all) {
  return select<D>(all > 0, lanes::clamp<D>(polarized / all, -1.0, 1.0), fill<D>(0));
}

template <class D>
VITRAIL_LANES Polarized<D> fresnel_polarized(D cosine, D eta) {
  const D sin2_transmitted = (1.0 - cosine * cosine) / (eta * eta);
  const D transmitted = safe_sqrt(1.0 - sin2_transmitted);
  const D s = (cosine - eta * transmitted) / (cosine + eta * transmitted);
  const D p = (eta * cosine - transmitted) / (eta * cosine + transmitted);
  const Mask<D> total = sin2_transmitted >= 1;
  // An index of 1 reflects nothing, also at grazing incidence, where both cosines vanish.
  const auto reflected = [&](D amplitude) {
    return select<D>(eta == 1, fill<D>(0), select<D>(total, fill<D>(1), amplitude * amplitude));
  };
  return {reflected(s), reflected(p)};
}

template <class D>
VITRAIL_LANES D fresnel_dielectric(D cosine, D eta) {
  const Polarized<D> r = fresnel_polarized(cosine, eta);
  return (r.s + r.p) / 2.0;
}

// Returns where light is refracted. Under total internal reflection it is false, and `refracted` is
// meaningless.
template <class D>
VITRAIL_LANES Mask<D> refract(Vector<D> out, Vector<D> normal, D eta, Vector<D>& refracted) {
  const D cosine = dot(out, normal);
  const D sin2_transmitted = lanes::max(fill<D>(0), 1.0 - cosine * cosine) / (eta * eta);
  const D transmitted = safe_sqrt(1.0 - sin2_transmitted);
  refracted = normalize(out * (-1.0 / eta) + normal * (cosine / eta - transmitted));
  return no(sin2_transmitted >= 1);
}

}  // namespace
}  // namespace vitrail::lanes
