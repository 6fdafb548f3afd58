// SPDX-License-Identifier: Apache-2.0
// This file has two parts of dielectric.h, for any number of lanes. One is the rough DielectricBsdf whose
// index is not 1; the other is the reflectance of a thin sheet.
#pragma once

#include "tracer/bsdf/bsdf_lanes.h"
#include "tracer/bsdf/local_lanes.h"
#include "tracer/bsdf/microfacet_lanes.h"

namespace vitrail::lanes {
namespace {

template <class D>
struct RoughDielectric {
  D eta;  // not 1
  Microfacets<D> microfacets;
  Four<FloatsLike<D>> reflectance_factor, transmittance_factor;
};

// Returns the share of light of that Q/I that a sheet of ThinDielectricBsdf of that index mirrors.
template <class D>
VITRAIL_LANES FloatsLike<D> sheet_reflectance(D cosine, D eta, D q) {
  const Polarized<D> r = fresnel_polarized<D>(lanes::min(cosine, fill<D>(1)), eta);
  return to_floats(part_of<D>(q, {2.0 * r.s / (1.0 + r.s), 2.0 * r.p / (1.0 + r.p)}));
}

namespace detail {

// It is the interface as seen with `out` above it.
template <class D>
struct Sighting {
  D side;  // −1 where the picture is upside down
  D eta;   // index on the other side / on this one
  Vector<D> out;
  VITRAIL_LANES Vector<D> turned(Vector<D> v) const { return {v.x, v.y, v.z * side}; }
};
template <class D>
VITRAIL_LANES Sighting<D> sight(const RoughDielectric<D>& b, Vector<D> out) {
  Sighting<D> s;
  s.side = select<D>(out.z > 0, fill<D>(1), fill<D>(-1));
  s.eta = select<D>(out.z > 0, b.eta, 1.0 / b.eta);
  s.out = s.turned(out);
  return s;
}

// It says how likely `sample` is to reflect; `some` is false where both factors are black.
template <class D>
struct Reflecting {
  Mask<D> some;
  D reflectance, probability;
};
template <class D>
VITRAIL_LANES Reflecting<D> reflecting(const RoughDielectric<D>& b, D cosine, D eta) {
  Reflecting<D> c;
  c.reflectance = fresnel_dielectric<D>(lanes::min(cosine, fill<D>(1)), eta);
  const D bright_r = c.reflectance * to_doubles(greatest(b.reflectance_factor)),
          bright_t = (1.0 - c.reflectance) * to_doubles(greatest(b.transmittance_factor));
  c.some = bright_r + bright_t > 0;
  c.probability = attainable<D>(bright_r / (bright_r + bright_t));
  return c;
}

// It is one pair of directions, out.z > 0, joined by a facet of normal m.
template <class D>
struct Facet {
  D out_m;
  D jacobian;     // dm/d in
  Mask<D> valid;  // both directions see the sides of the facet that they see of the surface
};
template <class D>
VITRAIL_LANES Facet<D> facet_of(Vector<D> out, Vector<D> in, Vector<D> m, D eta) {
  const Mask<D> reflected = in.z > 0;
  const D out_m = dot(out, m), in_m = dot(in, m);
  const D sum = out_m + eta * in_m;  // ≠ 0 as eta ≠ 1
  const D jacobian = select<D>(reflected, 1.0 / (4.0 * out_m), eta * eta * abs(in_m) / (sum * sum));
  Facet<D> facet{out_m, jacobian};
  facet.valid = (m.z > 0) & (out_m > 0) & ((reflected & (in_m > 0)) | (no(reflected) & (in_m < 0)));
  return facet;
}

// Returns the density of `in` through this facet; area = σ(out).
template <class D>
VITRAIL_LANES D facet_pdf(const Microfacets<D>& mf, D area, Vector<D> m, const Facet<D>& facet) {
  return facet.out_m * normal_density(mf, m) / area * facet.jacobian;
}
// Returns G₂/G₁(out), the part of the light from a visible facet that `in` sees too.
template <class D>
VITRAIL_LANES D seen(const Microfacets<D>& mf, Vector<D> out, D area, Vector<D> in) {
  return shadowing_over_cosines(mf, out, area, in) * abs(in.z) * area;
}

}  // namespace detail

template <class D>
VITRAIL_LANES BsdfValue<D> eval(const RoughDielectric<D>& b, Vector<D> out, Vector<D> in) {
  using F = FloatsLike<D>;
  const detail::Sighting<D> s = detail::sight(b, out);
  const Vector<D> to = s.turned(in);
  const Mask<D> reflected = to.z > 0;
  const Vector<D> half = normalize(select<D>(reflected, s.out + to, s.out + to * s.eta));
  const Vector<D> m = select<D>(half.z < 0, -half, half);
  const detail::Facet<D> facet = detail::facet_of(s.out, to, m, s.eta);
  const detail::Reflecting<D> choice = detail::reflecting(b, facet.out_m, s.eta);
  const D area = visible_area(b.microfacets, s.out);
  const D density = detail::facet_pdf(b.microfacets, area, m, facet);
  const D share = density * detail::seen(b.microfacets, s.out, area, to);
  const F back = to_floats(share * choice.reflectance),
          through = to_floats(share * (1.0 - choice.reflectance) / (s.eta * s.eta));
  BsdfValue<D> f;
  for (int i = 0; i < 4; ++i)
    f.value[i] = select<F>(mask_for<F>(reflected), b.reflectance_factor[i] * back,
                           b.transmittance_factor[i] * through);
  f.pdf = density * select<D>(reflected, choice.probability, 1.0 - choice.probability);
  return detail::where<D>((out.z != 0) & (in.z != 0) & facet.valid & choice.some & (density > 0), f);
}

template <class D>
VITRAIL_LANES BsdfSample<D> sample(const RoughDielectric<D>& b, Vector<D> out, FloatsLike<D> u_lobe,
                                   FloatsLike<D> u_x, FloatsLike<D> u_y) {
  using F = FloatsLike<D>;
  const Microfacets<D>& mf = b.microfacets;
  const detail::Sighting<D> s = detail::sight(b, out);
  const Vector<D> m = sample_visible_normal(mf, s.out, u_x, u_y);
  const D out_m = dot(s.out, m);
  const detail::Reflecting<D> choice = detail::reflecting(b, out_m, s.eta);
  const Mask<D> reflected = to_doubles(u_lobe) < choice.probability;
  Vector<D> refracted;
  const Mask<D> passes = refract(s.out, m, s.eta, refracted);
  const Vector<D> in = select<D>(reflected, mirror(s.out, m), refracted);
  const D area = visible_area(mf, s.out);
  const F seen = to_floats(detail::seen(mf, s.out, area, in));
  const F back = to_floats(choice.reflectance / choice.probability),
          through =
              to_floats((1.0 - choice.reflectance) / (1.0 - choice.probability)) / to_floats(s.eta * s.eta);
  BsdfSample<D> result;
  result.in = s.turned(in);
  for (int i = 0; i < 4; ++i)
    result.weight[i] = select<F>(mask_for<F>(reflected), b.reflectance_factor[i] * back,
                                 b.transmittance_factor[i] * through) *
                       seen;
  result.pdf = detail::facet_pdf(mf, area, m, detail::facet_of(s.out, in, m, s.eta)) *
               select<D>(reflected, choice.probability, 1.0 - choice.probability);
  const Mask<D> own_side = (reflected & (in.z > 0)) | (no(reflected) & passes & (in.z < 0));
  result.scatters = (s.out.z > 0) & choice.some & (out_m > 0) & own_side & (result.pdf > 0);
  result.specular = Mask<D>{};
  return result;
}

}  // namespace
}  // namespace vitrail::lanes
