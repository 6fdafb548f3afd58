// SPDX-License-Identifier: Apache-2.0
// This file has the bases that may lie under a coating, for any number of lanes. Directions are above it:
// z > 0.
#pragma once

#include "tracer/bsdf/fresnel_lanes.h"
#include "tracer/bsdf/local_lanes.h"
#include "tracer/bsdf/microfacet_lanes.h"

namespace vitrail::lanes {
namespace {

// It is a direction, where one is `found`, with the weight f·|cos θ_in| / pdf. The pdf is in solid angle, and
// 1 where the base is smooth.
template <class D>
struct BaseSample {
  Mask<D> found;
  Vector<D> in;
  Four<FloatsLike<D>> weight;
  D pdf;
};

template <class D>
struct LambertBase {
  Four<FloatsLike<D>> reflectance;
  VITRAIL_LANES Mask<D> smooth() const { return Mask<D>{}; }
};

template <class D>
struct ConductorBase {
  Four<FloatsLike<D>> eta, k;
  D interface_eta;  // of the coating, that the metal lies in
  Microfacets<D> facets;
  Mask<D> is_smooth;
  VITRAIL_LANES Mask<D> smooth() const { return is_smooth; }
};

namespace detail {

template <class D>
VITRAIL_LANES Mask<D> are_above(Vector<D> out, Vector<D> in) {
  return (out.z > 0) & (in.z > 0);
}

template <class D>
VITRAIL_LANES Four<FloatsLike<D>> scaled(Four<FloatsLike<D>> s, D factor) {
  const FloatsLike<D> narrow = to_floats(factor);
  for (int i = 0; i < 4; ++i) s[i] = s[i] * narrow;
  return s;
}
template <class D>
VITRAIL_LANES Four<FloatsLike<D>> black_unless(Mask<D> mask, Four<FloatsLike<D>> s) {
  using F = FloatsLike<D>;
  for (int i = 0; i < 4; ++i) s[i] = select<F>(mask_for<F>(mask), s[i], fill<F>(0));
  return s;
}

template <class D>
[[gnu::noinline]] Four<FloatsLike<D>> reflectance(const ConductorBase<D>& b, D cosine) {
  const D scale = 1.0 / to_doubles(to_floats(b.interface_eta)), c = lanes::clamp<D>(cosine, 0.0, 1.0);
  Four<FloatsLike<D>> result;
  for (int i = 0; i < 4; ++i)
    result[i] = to_floats(fresnel_conductor<D>(c, to_doubles(b.eta[i]) * scale, to_doubles(b.k[i]) * scale));
  return result;
}

template <class D>
VITRAIL_LANES D shadowing(const ConductorBase<D>& b, Vector<D> out, Vector<D> in) {
  return shadowing_over_cosines(b.facets, out, visible_area(b.facets, out), in);
}

}  // namespace detail

// It returns f without the cosine, 0 where the base is smooth.
template <class D>
VITRAIL_LANES Four<FloatsLike<D>> base_value(const LambertBase<D>& b, Vector<D> out, Vector<D> in) {
  return detail::black_unless<D>(detail::are_above(out, in),
                                 detail::scaled<D>(b.reflectance, fill<D>(1 / pi)));
}
template <class D>
VITRAIL_LANES D base_pdf(const LambertBase<D>&, Vector<D> out, Vector<D> in) {
  return select<D>(detail::are_above(out, in), in.z / pi, fill<D>(0));
}
template <class D>
VITRAIL_LANES BaseSample<D> sample_base(const LambertBase<D>& b, Vector<D> out, FloatsLike<D> u_x,
                                        FloatsLike<D> u_y) {
  const Vector<D> in = sample_cosine_hemisphere(u_x, u_y);
  return {detail::are_above(out, in), in, b.reflectance, in.z / pi};
}

template <class D>
[[gnu::noinline]] Four<FloatsLike<D>> base_value(const ConductorBase<D>& b, Vector<D> out, Vector<D> in) {
  const Vector<D> h = normalize(out + in);  // h.z > 0
  constexpr double most = 1e30;             // where both directions graze
  const D facets = normal_density(b.facets, h) * detail::shadowing(b, out, in) / 4.0;
  return detail::black_unless<D>(
      no(b.is_smooth) & detail::are_above(out, in),
      detail::scaled<D>(detail::reflectance<D>(b, dot(out, h)), lanes::min(fill<D>(most), facets)));
}
template <class D>
[[gnu::noinline]] D base_pdf(const ConductorBase<D>& b, Vector<D> out, Vector<D> in) {
  const Vector<D> h = normalize(out + in);
  const D half = dot(out, h);
  const D pdf =
      lanes::max(fill<D>(0), half) * normal_density(b.facets, h) / visible_area(b.facets, out) / (4.0 * half);
  return select<D>(no(b.is_smooth) & detail::are_above(out, in) & (half > 0), pdf, fill<D>(0));
}
template <class D>
[[gnu::noinline]] BaseSample<D> sample_base(const ConductorBase<D>& b, Vector<D> out, FloatsLike<D> u_x,
                                            FloatsLike<D> u_y) {
  Vector<D> m = fill<D>(Vector3d{0, 0, 1}), in{-out.x, -out.y, out.z};
  D pdf = fill<D>(1), seen = fill<D>(1);
  if (!all(b.is_smooth)) {
    m = select<D>(b.is_smooth, m, sample_visible_normal(b.facets, out, u_x, u_y));
    in = select<D>(b.is_smooth, in, m * (2.0 * dot(out, m)) - out);
    pdf = select<D>(b.is_smooth, pdf, base_pdf(b, out, in));
    seen = select<D>(b.is_smooth, seen, detail::shadowing(b, out, in) * in.z * visible_area(b.facets, out));
  }
  const Mask<D> found = detail::are_above(out, in) & (pdf > 0);
  return {found, in, detail::scaled<D>(detail::reflectance<D>(b, dot(out, m)), seen), pdf};
}

}  // namespace
}  // namespace vitrail::lanes
