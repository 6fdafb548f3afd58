// SPDX-License-Identifier: Apache-2.0
// This file has the dielectric interface above a layer, met from either side, of one colour (Walter et al.
// 2007), for any number of lanes. `out` and `in` may lie on either side: z > 0 is above. The long functions
// are not inlined: a walk calls each several times.
#pragma once

#include "tracer/bsdf/local_lanes.h"
#include "tracer/bsdf/microfacet_lanes.h"

namespace vitrail::lanes {
namespace {

template <class D>
struct Coating {
  D eta;  // below / above
  Microfacets<D> facets;
  Mask<D> smooth;  // then its facets count for nothing
};

// It is a direction, where one is `found`, with the weight f·|cos θ_in| / pdf. The pdf is in solid angle, and
// 1 where the coating is smooth. Weights are those of radiance from `in`. For light that goes from `out`
// instead, they are η² times as large, η the index across / the index on the side of `out`.
template <class D>
struct CoatingSample {
  Mask<D> found;
  Vector<D> in;
  D weight, pdf;
};

namespace detail {

template <class D>
VITRAIL_LANES D eta_from(const Coating<D>& c, Vector<D> out) {
  return select<D>(out.z > 0, c.eta, 1.0 / c.eta);
}
template <class D>
VITRAIL_LANES Vector<D> above(Vector<D> v) {
  return select<D>(v.z > 0, v, -v);
}

// It holds the half vector of two directions, on one side or on both, h.z ≥ 0. It also has the reflectance of
// a facet that `out` meets, and whether both directions see the facet as they should.
template <class D>
struct CoatingHalf {
  Vector<D> h;
  D eta;  // on the other side of `out` / on its side
  D out_h, in_h, fresnel;
  Mask<D> valid;
};
template <class D>
VITRAIL_LANES CoatingHalf<D> coating_half(const Coating<D>& c, Vector<D> out, Vector<D> in) {
  CoatingHalf<D> r;
  r.eta = eta_from(c, out);
  const Mask<D> reflects = out.z * in.z > 0;
  const Vector<D> half = normalize(select<D>(reflects, out + in, out + in * r.eta));
  r.h = select<D>(half.z < 0, -half, half);
  r.out_h = dot(out, r.h), r.in_h = dot(in, r.h);
  r.valid = (r.h.z > 0) & (r.out_h * out.z > 0) & (r.in_h * in.z > 0);
  r.fresnel = fresnel_dielectric<D>(lanes::min(fill<D>(1), abs(r.out_h)), r.eta);
  return r;
}

template <class D>
VITRAIL_LANES D shadowing(const Coating<D>& c, Vector<D> out, Vector<D> in) {
  const Vector<D> seen = above(out);
  return shadowing_over_cosines(c.facets, seen, visible_area(c.facets, seen), in);
}

template <class D>
VITRAIL_LANES D visible_normal_pdf(const Microfacets<D>& mf, Vector<D> v, Vector<D> m) {
  return lanes::max(fill<D>(0), dot(v, m)) * normal_density(mf, m) / visible_area(mf, v);
}

// It is a facet as seen from `out`: its normal on that side, and its reflectance.
template <class D>
struct CoatingFacet {
  Vector<D> normal;
  D eta, fresnel;
};
template <class D>
[[gnu::noinline]] CoatingFacet<D> sample_facet(const Coating<D>& c, Vector<D> out, FloatsLike<D> u_x,
                                               FloatsLike<D> u_y) {
  const D side = select<D>(out.z > 0, fill<D>(1), fill<D>(-1)), eta = eta_from(c, out);
  Vector<D> m = fill<D>(Vector3d{0, 0, 1});
  if (!all(c.smooth)) m = select<D>(c.smooth, m, sample_visible_normal(c.facets, out * side, u_x, u_y));
  return {m * side, eta, fresnel_dielectric<D>(lanes::clamp<D>(dot(out, m) * side, 0.0, 1.0), eta)};
}

}  // namespace detail

// They return f without the cosine, 0 where the coating is smooth. Values are of radiance: transmitted ones
// have the factor 1/η².
template <class D>
[[gnu::noinline]] D coating_reflection(const Coating<D>& c, Vector<D> out, Vector<D> in) {
  if (all(c.smooth)) return fill<D>(0);
  const detail::CoatingHalf<D> half = detail::coating_half(c, out, in);
  const D value = half.fresnel * normal_density(c.facets, half.h) * detail::shadowing(c, out, in) / 4.0;
  return select<D>(half.valid & no(c.smooth), value, fill<D>(0));
}
template <class D>
[[gnu::noinline]] D coating_transmission(const Coating<D>& c, Vector<D> out, Vector<D> in) {
  if (all(c.smooth)) return fill<D>(0);
  const detail::CoatingHalf<D> half = detail::coating_half(c, out, in);
  const D sum = half.out_h + half.eta * half.in_h;
  const D value = (1.0 - half.fresnel) * normal_density(c.facets, half.h) * detail::shadowing(c, out, in) *
                  abs(half.out_h * half.in_h) / (sum * sum);
  return select<D>(half.valid & (sum != 0) & no(c.smooth), value, fill<D>(0));
}

// They return the density of a sample that is known to be reflected, or to be transmitted: 0 where the
// coating is smooth.
template <class D>
[[gnu::noinline]] D coating_reflected_pdf(const Coating<D>& c, Vector<D> out, Vector<D> in) {
  if (all(c.smooth)) return fill<D>(0);
  const detail::CoatingHalf<D> half = detail::coating_half(c, out, in);
  // out_h ≠ 0 where it is valid.
  const D pdf = detail::visible_normal_pdf(c.facets, detail::above(out), half.h) / (4.0 * abs(half.out_h));
  return select<D>(half.valid & no(c.smooth), pdf, fill<D>(0));
}
template <class D>
[[gnu::noinline]] D coating_transmitted_pdf(const Coating<D>& c, Vector<D> out, Vector<D> in) {
  if (all(c.smooth)) return fill<D>(0);
  const detail::CoatingHalf<D> half = detail::coating_half(c, out, in);
  const D sum = half.out_h + half.eta * half.in_h;
  const D pdf = detail::visible_normal_pdf(c.facets, detail::above(out), half.h) * half.eta * half.eta *
                abs(half.in_h) / (sum * sum);
  return select<D>(half.valid & (sum != 0) & (half.fresnel < 1) & no(c.smooth), pdf, fill<D>(0));
}

namespace detail {

// Returns G₂/G₁ = G₂/(|out.z|·|in.z|)·|in.z|·σ(out).
template <class D>
VITRAIL_LANES D seen_share(const Coating<D>& c, Vector<D> out, Vector<D> in) {
  if (all(c.smooth)) return fill<D>(1);
  const D share = shadowing(c, out, in) * abs(in.z) * visible_area(c.facets, above(out));
  return select<D>(c.smooth, fill<D>(1), share);
}
template <class D>
VITRAIL_LANES CoatingSample<D> reflect(const Coating<D>& c, Vector<D> out, const CoatingFacet<D>& f) {
  CoatingSample<D> s;
  s.in = f.normal * (2.0 * dot(out, f.normal)) - out;
  s.weight = seen_share(c, out, s.in);
  s.pdf = select<D>(c.smooth, fill<D>(1), coating_reflected_pdf(c, out, s.in));
  s.found = (s.in.z * out.z > 0) & (s.pdf > 0);
  return s;
}
template <class D>
VITRAIL_LANES CoatingSample<D> transmit(const Coating<D>& c, Vector<D> out, const CoatingFacet<D>& f) {
  CoatingSample<D> s;
  const Mask<D> passes = refract(out, f.normal, f.eta, s.in);
  s.weight = seen_share(c, out, s.in) / (f.eta * f.eta);
  s.pdf = select<D>(c.smooth, fill<D>(1), coating_transmitted_pdf(c, out, s.in));
  s.found = passes & (s.in.z * out.z < 0) & (s.pdf > 0);
  return s;
}
template <class D>
VITRAIL_LANES CoatingSample<D> scaled(CoatingSample<D> s, D factor) {
  s.weight = s.weight * factor;
  s.found = s.found & (factor > 0);
  return s;
}

}  // namespace detail

template <class D>
[[gnu::noinline]] CoatingSample<D> sample_coating_reflection(const Coating<D>& c, Vector<D> out,
                                                             FloatsLike<D> u_x, FloatsLike<D> u_y) {
  const detail::CoatingFacet<D> f = detail::sample_facet(c, out, u_x, u_y);
  CoatingSample<D> s = detail::scaled(detail::reflect(c, out, f), f.fresnel);
  s.found = s.found & (out.z != 0);
  return s;
}
template <class D>
[[gnu::noinline]] CoatingSample<D> sample_coating_transmission(const Coating<D>& c, Vector<D> out,
                                                               FloatsLike<D> u_x, FloatsLike<D> u_y) {
  const detail::CoatingFacet<D> f = detail::sample_facet(c, out, u_x, u_y);
  CoatingSample<D> s = detail::scaled<D>(detail::transmit(c, out, f), 1.0 - f.fresnel);
  s.found = s.found & (out.z != 0);
  return s;
}

// Samples either, chosen by the reflectance of the facet. The weight leaves this reflectance out, and the pdf
// is that of the chosen one alone.
template <class D>
[[gnu::noinline]] CoatingSample<D> sample_coating(const Coating<D>& c, Vector<D> out, D u_lobe,
                                                  FloatsLike<D> u_x, FloatsLike<D> u_y) {
  const detail::CoatingFacet<D> f = detail::sample_facet(c, out, u_x, u_y);
  const CoatingSample<D> back = detail::reflect(c, out, f), through = detail::transmit(c, out, f);
  const Mask<D> reflects = u_lobe < f.fresnel;
  const Mask<D> found = ((reflects & back.found) | (no(reflects) & through.found)) & (out.z != 0);
  return {found, select<D>(reflects, back.in, through.in), select<D>(reflects, back.weight, through.weight),
          select<D>(reflects, back.pdf, through.pdf)};
}

}  // namespace
}  // namespace vitrail::lanes
