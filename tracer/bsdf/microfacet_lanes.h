// SPDX-License-Identifier: Apache-2.0
// This file has what microfacet.h declares, for any number of lanes. Distributions and maskings may differ
// from lane to lane.
#pragma once

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/microfacet.h"
#include "tracer/simd/quick_math.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

// The facets are not smooth: alpha_u, alpha_v ≥ least_alpha.
template <class D>
struct Microfacets {
  D alpha_u, alpha_v;
  Mask<D> beckmann;   // else GGX
  Mask<D> separable;  // else correlated
};
// get(j) gives the vitrail::Microfacets of lane j.
template <class D, class Get>
VITRAIL_LANES Microfacets<D> gather_microfacets(const Get& get) {
  return {gather<D>([&](int j) __attribute__((always_inline)) { return get(j).alpha_u; }),
          gather<D>([&](int j) __attribute__((always_inline)) { return get(j).alpha_v; }),
          gather_mask<D>([&](int j) __attribute__((always_inline)) {
            return get(j).distribution == Roughness::Distribution::beckmann;
          }),
          gather_mask<D>([&](int j) __attribute__((always_inline)) {
            return get(j).masking == Masking::separable;
          })};
}

// Returns them in one lane.
VITRAIL_LANES Microfacets<double> fill(const vitrail::Microfacets& mf) {
  return gather_microfacets<double>([&](int) -> const vitrail::Microfacets& { return mf; });
}

namespace detail {

inline constexpr double sqrt_pi = 1.77245385090551602730;

// Returns Beckmann's σ from v.z = z and the length s of v's horizontal part stretched by α (Walter et al.
// 2007, Eq. 26's exact form; Heitz 2014, Eq. 66).
template <class D>
VITRAIL_LANES D beckmann_area(D z, D s) {
  const D a = abs(z) / s, gauss = quick_exp<D>(-a * a), erf = quick_erf(a, gauss);
  const D grazing = (z * (1.0 + select<D>(z < 0, -erf, erf)) + s / sqrt_pi * gauss) / 2.0;
  // 1 − erf 6 < 3e-17; s may be 0 there, and only there.
  return select<D>(abs(z) >= 6.0 * s, lanes::max(z, fill<D>(0)), grazing);
}

template <class D>
VITRAIL_LANES Vector<D> stretched(const Microfacets<D>& mf, Vector<D> v) {
  return normalize(Vector<D>{mf.alpha_u * v.x, mf.alpha_v * v.y, v.z});
}

template <class D>
VITRAIL_LANES Vector<D> sample_ggx(const Microfacets<D>& mf, Vector<D> v, D u_x, D u_y) {
  const Vector<D> w = stretched(mf, v);
  const Circle<D> circle = quick_circle(u_x);
  const D z = (1.0 - u_y) * (1.0 + w.z) - w.z;
  const D s = safe_sqrt(1.0 - z * z);
  // The z of h is (1 − u_y)·(1 + w.z) > 0.
  const Vector<D> h = w + Vector<D>{s * circle.cosine, s * circle.sine, z};
  return normalize(Vector<D>{mf.alpha_u * h.x, mf.alpha_v * h.y, h.z});
}

// Samples the slope towards the viewer at polar angle θ on a surface of unit width. Its density is in
// proportion to max(0, cosθ + x·sinθ)·exp(−x²). The function solves for t = erf(−x), in which the cumulative
// distribution cosθ·(1 + t)/2 + sinθ·exp(−x²)/(2√π) is concave, by Halley's method kept within a bracket.
template <class D>
VITRAIL_LANES D sample_beckmann_slope(D cosine, D sine, D u) {
  const D cotangent = select<D>(cosine < 6.0 * sine, cosine / sine, fill<D>(6));
  const D gauss = quick_exp<D>(-cotangent * cotangent), limit = quick_erf(cotangent, gauss);
  const D share = lanes::max(u, fill<D>(1e-9));
  const D target = share * (cosine * (1.0 + limit) + sine / sqrt_pi * gauss) / 2.0;
  const D grazing = lanes::sqrt(-quick_log(share));  // −x where sinθ = 1
  D low = fill<D>(-1), high = limit, t = limit - (1.0 + limit) * quick_erf(grazing, share);
  constexpr int most_steps = 12;  // two are usual
  Mask<D> goes_on = low < 0;
  for (int step = 0; step < most_steps && any(goes_on); ++step) {
    const D x = inverse_erf(t), bell = quick_exp<D>(-x * x);
    const D error = (cosine * (1.0 + t) + sine / sqrt_pi * bell) / 2.0 - target;
    const Mask<D> above = error > 0;
    high = select<D>(goes_on & above, t, high);
    low = select<D>(goes_on & no(above), t, low);
    const Mask<D> close = abs(error) < 1e-3 * target;  // and 1e-5 a step later
    const D slope = (cosine - x * sine) / 2.0, curvature = -sine * sqrt_pi / (4.0 * bell);
    const D denominator = 2.0 * slope * slope - error * curvature;
    const D next = select<D>(denominator > 0, t - 2.0 * error * slope / denominator, low);
    const D clamped = select<D>(next < low, low, select<D>(high < next, high, next));
    const D within = select<D>((next > low) & (next < high), next, (low + high) / 2.0);
    t = select<D>(goes_on, select<D>(close, clamped, within), t);
    goes_on = goes_on & no(close);
  }
  return -inverse_erf(t);
}

template <class D>
VITRAIL_LANES Vector<D> sample_beckmann(const Microfacets<D>& mf, Vector<D> v, D u_x, D u_y) {
  const Vector<D> w = stretched(mf, v);
  const D sine = lanes::sqrt(w.x * w.x + w.y * w.y);
  const D along = sample_beckmann_slope(w.z, sine, u_x);
  const D across = inverse_erf<D>(2.0 * lanes::clamp(u_y, 1e-9, 1 - 1e-9) - 1.0);
  const Mask<D> leans = sine > 0;
  const D c = select<D>(leans, w.x / sine, fill<D>(1)), s = select<D>(leans, w.y / sine, fill<D>(0));
  return normalize(
      Vector<D>{mf.alpha_u * (c * along - s * across), mf.alpha_v * (s * along + c * across), fill<D>(1)});
}

// Returns of_ggx() or of_beckmann(), each for the lanes that have that distribution.
template <class D, class OfGgx, class OfBeckmann>
VITRAIL_LANES auto by_distribution(Mask<D> beckmann, const OfGgx& of_ggx, const OfBeckmann& of_beckmann) {
  if (!any(beckmann)) return of_ggx();
  if (all(beckmann)) return of_beckmann();
  return select(beckmann, of_beckmann(), of_ggx());
}

}  // namespace detail

template <class D>
VITRAIL_LANES D normal_density(const Microfacets<D>& mf, Vector<D> m) {
  const D x = m.x / mf.alpha_u, y = m.y / mf.alpha_v;
  const D area = pi * mf.alpha_u * mf.alpha_v;
  const D density = detail::by_distribution<D>(
      mf.beckmann,
      [&]() __attribute__((always_inline)) {
        const D q = x * x + y * y + m.z * m.z;
        return 1.0 / (area * q * q);
      },
      [&]() __attribute__((always_inline)) {
        const D z2 = m.z * m.z, r2 = x * x + y * y;
        return select<D>(r2 < 700.0 * z2, quick_exp<D>(-r2 / z2) / (area * z2 * z2), fill<D>(0));
      });
  return select<D>(m.z > 0, density, fill<D>(0));
}

template <class D>
VITRAIL_LANES D visible_area(const Microfacets<D>& mf, Vector<D> v) {
  const D x = mf.alpha_u * v.x, y = mf.alpha_v * v.y;
  const D s = lanes::sqrt(x * x + y * y);
  return detail::by_distribution<D>(
      mf.beckmann,
      [&]() __attribute__((always_inline)) { return (v.z + lanes::sqrt(v.z * v.z + s * s)) / 2.0; },
      [&]() __attribute__((always_inline)) { return detail::beckmann_area(v.z, s); });
}

template <class D>
VITRAIL_LANES D shadowing_over_cosines(const Microfacets<D>& mf, Vector<D> a, D area_a, Vector<D> b) {
  b = select<D>(b.z < 0, -b, b);
  const D area_b = visible_area(mf, b);
  const D product = area_a * b.z + area_b * a.z - a.z * b.z;  // ≥ a.z·b.z, as σ(v) ≥ v.z
  const D correlated = select<D>(product > 0, 1.0 / product, fill<D>(0));
  return select<D>(mf.separable, 1.0 / (area_a * area_b), correlated);
}

template <class D>
VITRAIL_LANES Vector<D> sample_visible_normal(const Microfacets<D>& mf, Vector<D> v, FloatsLike<D> u_x,
                                              FloatsLike<D> u_y) {
  const D x = to_doubles(u_x), y = to_doubles(u_y);
  return detail::by_distribution<D>(
      mf.beckmann, [&]() __attribute__((always_inline)) { return detail::sample_ggx(mf, v, x, y); },
      [&]() __attribute__((always_inline)) { return detail::sample_beckmann(mf, v, x, y); });
}

template <class D>
VITRAIL_LANES Vector<D> mirror(Vector<D> out, Vector<D> m) {
  return m * (2.0 * dot(out, m)) - out;
}

}  // namespace
}  // namespace vitrail::lanes
