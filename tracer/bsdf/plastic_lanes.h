// SPDX-License-Identifier: Apache-2.0
// This file has what plastic.h declares, for any number of lanes.
#pragma once

#include "tracer/bsdf/bsdf_lanes.h"
#include "tracer/bsdf/local_lanes.h"
#include "tracer/bsdf/microfacet_lanes.h"
#include "tracer/bsdf/plastic.h"

namespace vitrail::lanes {
namespace {

// It has what vitrail::PlasticBsdf and RoughPlasticBsdf share.
template <class D>
struct Plastic {
  Four<FloatsLike<D>> diffuse, specular;  // reflectances
  D eta;
  D internal_reflectance;
  Mask<D> nonlinear;
};
// table(j) is the RoughPlasticTables::external_transmittance of lane j.
template <class D, class TableOf>
struct RoughPlastic {
  Plastic<D> plastic;
  Microfacets<D> microfacets;
  TableOf table;
};

namespace detail {

template <class D>
VITRAIL_LANES D mean(const Four<FloatsLike<D>>& s) {
  return (((fill<D>(0) + to_doubles(s[0])) + to_doubles(s[1])) + to_doubles(s[2]) + to_doubles(s[3])) / 4.0;
}

template <class D>
VITRAIL_LANES D transmittance(const Plastic<D>& bsdf, D cosine) {
  return 1.0 - fresnel_dielectric<D>(lanes::min(cosine, fill<D>(1)), bsdf.eta);
}
template <class D, class TableOf>
VITRAIL_LANES D transmittance(const RoughPlastic<D, TableOf>& bsdf, D cosine) {
  constexpr int last = RoughPlasticTables::count - 1;
  // This order makes the NaN of an idle lane 0.
  const D x = lanes::min(fill<D>(1), lanes::max(fill<D>(0), cosine)) * static_cast<double>(last);
  const auto i = lanes::min(convert<std::int32_t>(x), fill<IntsLike<D>>(last - 1));
  const auto value = [&](int more) __attribute__((always_inline)) {
    return to_doubles(gather<FloatsLike<D>>([&](int j) __attribute__((always_inline)) {
      return bsdf.table(j)[lane(i, j) + more];
    }));
  };
  const D here = value(0);
  return here + (x - to_doubles(i)) * (value(1) - here);
}

// Returns the probability of sampling the coat's reflection rather than the base, where the coat reflects
// `reflectance` (Mitsuba's choice).
template <class D>
VITRAIL_LANES D specular_probability(const Plastic<D>& bsdf, D reflectance) {
  const D s = reflectance * mean<D>(bsdf.specular), d = (1.0 - reflectance) * mean<D>(bsdf.diffuse);
  return select<D>(s + d > 0, attainable(s / (s + d)), fill<D>(1));
}

// Returns f/(T(out)·T(in)) of the base, times π.
template <class D>
VITRAIL_LANES Four<FloatsLike<D>> base(const Plastic<D>& bsdf) {
  using F = FloatsLike<D>;
  const F r = to_floats(bsdf.internal_reflectance), inverse_eta2 = to_floats(1.0 / (bsdf.eta * bsdf.eta));
  const Mask<F> nonlinear = mask_for<F>(bsdf.nonlinear);
  Four<F> result = bsdf.diffuse;
  for (int i = 0; i < 4; ++i)
    result[i] = result[i] * (inverse_eta2 / (1.0f - r * select<F>(nonlinear, result[i], fill<F>(1))));
  return result;
}

}  // namespace detail

// They are for a smooth coat; `eval` leaves out the coat's reflection.
template <class D>
VITRAIL_LANES BsdfValue<D> eval(const Plastic<D>& bsdf, Vector<D> out, Vector<D> in) {
  const D t_out = detail::transmittance(bsdf, out.z), t_in = detail::transmittance(bsdf, in.z);
  const FloatsLike<D> value = to_floats(t_out * t_in * in.z / pi);
  BsdfValue<D> f{detail::base(bsdf), (1.0 - detail::specular_probability<D>(bsdf, 1.0 - t_out)) * in.z / pi};
  for (int i = 0; i < 4; ++i) f.value[i] = f.value[i] * value;
  return detail::where<D>((out.z > 0) & (in.z > 0), f);
}

template <class D>
VITRAIL_LANES BsdfSample<D> sample(const Plastic<D>& bsdf, Vector<D> out, FloatsLike<D> u_lobe,
                                   FloatsLike<D> u_x, FloatsLike<D> u_y) {
  using F = FloatsLike<D>;
  const D t_out = detail::transmittance(bsdf, out.z);
  const D specular = detail::specular_probability<D>(bsdf, 1.0 - t_out);
  BsdfSample<D> s;
  s.specular = to_doubles(u_lobe) < specular;
  s.in = sample_cosine_hemisphere(u_x, u_y);
  const F coat = to_floats((1.0 - t_out) / specular),
          below = to_floats(t_out * detail::transmittance(bsdf, s.in.z) / (1.0 - specular));
  const Mask<F> of_coat = mask_for<F>(s.specular);
  s.weight = detail::base(bsdf);
  for (int i = 0; i < 4; ++i) s.weight[i] = select<F>(of_coat, bsdf.specular[i] * coat, s.weight[i] * below);
  s.pdf = select<D>(s.specular, fill<D>(0), (1.0 - specular) * s.in.z / pi);
  s.in = select<D>(s.specular, {-out.x, -out.y, out.z}, s.in);
  s.scatters = (out.z > 0) & (s.specular | (s.in.z > 0));
  return s;
}

template <class D, class TableOf>
VITRAIL_LANES BsdfValue<D> eval(const RoughPlastic<D, TableOf>& bsdf, Vector<D> out, Vector<D> in) {
  using F = FloatsLike<D>;
  const Plastic<D>& plastic = bsdf.plastic;
  const Vector<D> m = normalize(out + in);
  const D facets = normal_density(bsdf.microfacets, m), area = visible_area(bsdf.microfacets, out);
  const D t_out = detail::transmittance(bsdf, out.z);
  const F coat = to_floats(fresnel_dielectric<D>(lanes::min(dot(out, m), fill<D>(1)), plastic.eta) * facets *
                           shadowing_over_cosines(bsdf.microfacets, out, area, in) * in.z / 4.0);
  const F diffuse = to_floats(t_out * detail::transmittance(bsdf, in.z) * in.z / pi);
  const D specular = detail::specular_probability<D>(plastic, 1.0 - t_out);
  BsdfValue<D> f{detail::base(plastic), specular * facets / (4.0 * area) + (1.0 - specular) * in.z / pi};
  for (int i = 0; i < 4; ++i) f.value[i] = plastic.specular[i] * coat + f.value[i] * diffuse;
  return detail::where<D>((out.z > 0) & (in.z > 0), f);
}

template <class D, class TableOf>
VITRAIL_LANES BsdfSample<D> sample(const RoughPlastic<D, TableOf>& bsdf, Vector<D> out, FloatsLike<D> u_lobe,
                                   FloatsLike<D> u_x, FloatsLike<D> u_y) {
  const D specular = detail::specular_probability<D>(bsdf.plastic, 1.0 - detail::transmittance(bsdf, out.z));
  const Mask<D> of_coat = to_doubles(u_lobe) < specular;
  BsdfSample<D> s;
  s.in = sample_cosine_hemisphere(u_x, u_y);
  if (any(of_coat))
    s.in = select<D>(of_coat, mirror(out, sample_visible_normal(bsdf.microfacets, out, u_x, u_y)), s.in);
  const BsdfValue<D> f = eval(bsdf, out, s.in);
  s.scatters = (out.z > 0) & (f.pdf > 1e-30);
  s.pdf = f.pdf;
  s.weight = f.value;
  for (int i = 0; i < 4; ++i) s.weight[i] = s.weight[i] * to_floats(1.0 / f.pdf);
  s.specular = Mask<D>{};
  return s;
}

}  // namespace
}  // namespace vitrail::lanes
