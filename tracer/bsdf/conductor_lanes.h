// SPDX-License-Identifier: Apache-2.0
// This file has what conductor.h declares, for any number of lanes.
#pragma once

#include "tracer/bsdf/bsdf_lanes.h"
#include "tracer/bsdf/fresnel_lanes.h"
#include "tracer/bsdf/microfacet_lanes.h"

namespace vitrail::lanes {
namespace {

// It is a vitrail::ConductorBsdf that is rough, or, in sample_mirror, smooth.
template <class D>
struct Conductor {
  Microfacets<D> microfacets;
  Four<FloatsLike<D>> eta, k, factor;
  Mask<D> perfect;
};

template <class D>
VITRAIL_LANES Four<FloatsLike<D>> reflectance(const Conductor<D>& bsdf, D cosine) {
  using F = FloatsLike<D>;
  Four<F> result = bsdf.factor;
  if (all(bsdf.perfect)) return result;
  const D c = lanes::min(cosine, fill<D>(1));
  const Mask<F> perfect = mask_for<F>(bsdf.perfect);
  for (int i = 0; i < 4; ++i) {
    const F metal = to_floats(fresnel_conductor<D>(c, to_doubles(bsdf.eta[i]), to_doubles(bsdf.k[i])));
    result[i] = select<F>(perfect, result[i], result[i] * metal);
  }
  return result;
}

template <class D>
VITRAIL_LANES BsdfValue<D> eval(const Conductor<D>& bsdf, Vector<D> out, Vector<D> in) {
  const Vector<D> m = normalize(out + in);
  const D facets = normal_density(bsdf.microfacets, m), area = visible_area(bsdf.microfacets, out);
  const D value = facets * shadowing_over_cosines(bsdf.microfacets, out, area, in) * in.z / 4.0;
  BsdfValue<D> f{reflectance(bsdf, dot(out, m)), facets / (4.0 * area)};
  for (int i = 0; i < 4; ++i) f.value[i] = f.value[i] * to_floats(value);
  return detail::where<D>((out.z > 0) & (in.z > 0) & (facets > 0), f);
}

template <class D>
VITRAIL_LANES BsdfSample<D> sample(const Conductor<D>& bsdf, Vector<D> out, FloatsLike<D> u_x,
                                   FloatsLike<D> u_y) {
  const Microfacets<D>& mf = bsdf.microfacets;
  BsdfSample<D> s;
  const Vector<D> m = sample_visible_normal(mf, out, u_x, u_y);
  s.in = mirror(out, m);
  const D area = visible_area(mf, out), out_m = dot(out, m);
  s.pdf = normal_density(mf, m) / (4.0 * area);                                // dm/d in = 1/(4·out·m)
  const D seen = shadowing_over_cosines(mf, out, area, s.in) * s.in.z * area;  // G₂/G₁
  s.weight = reflectance(bsdf, out_m);
  for (int i = 0; i < 4; ++i) s.weight[i] = s.weight[i] * to_floats(seen);
  s.scatters = (out.z > 0) & (s.in.z > 0) & (out_m > 0) & (s.pdf > 0);
  s.specular = Mask<D>{};
  return s;
}

template <class D>
VITRAIL_LANES BsdfSample<D> sample_mirror(const Conductor<D>& bsdf, Vector<D> out) {
  return {out.z > 0, {-out.x, -out.y, out.z}, reflectance(bsdf, out.z), fill<D>(0), out.z > 0};
}

}  // namespace
}  // namespace vitrail::lanes
