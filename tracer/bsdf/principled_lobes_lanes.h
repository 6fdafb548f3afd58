// SPDX-License-Identifier: Apache-2.0
// This file has what principled_lobes.h declares, for any number of lanes.
#pragma once

#include "tracer/bsdf/local_lanes.h"
#include "tracer/bsdf/microfacet_lanes.h"
#include "tracer/simd/quick_math.h"

namespace vitrail::lanes {
namespace {
namespace principled {

template <class D>
VITRAIL_LANES D schlick_weight(D cosine) {
  const D m = lanes::clamp<D>(1.0 - cosine, 0.0, 1.0);
  return m * m * (m * m) * m;
}

template <class D>
VITRAIL_LANES D schlick_weight(D cosine, D eta) {
  const D across = safe_sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
  return schlick_weight<D>(select<D>(eta > 1, cosine, across));
}

template <class D>
VITRAIL_LANES Four<FloatsLike<D>> schlick(const Four<FloatsLike<D>>& normal_reflectance, D weight) {
  const FloatsLike<D> w = to_floats(weight);
  Four<FloatsLike<D>> f;
  for (int i = 0; i < 4; ++i) f[i] = normal_reflectance[i] * (1.0f - w) + w;
  return f;
}

template <class D>
VITRAIL_LANES D normal_reflectance(D eta) {
  const D r = (eta - 1.0) / (eta + 1.0);
  return r * r;
}

template <class D>
VITRAIL_LANES Four<FloatsLike<D>> tint(const Four<FloatsLike<D>>& base_color, D luminance, D amount) {
  using F = FloatsLike<D>;
  const F a = to_floats(amount), of_color = to_floats(amount / luminance);
  const Mask<F> colored = mask_for<F>(luminance > 0);
  Four<F> f;
  for (int i = 0; i < 4; ++i) f[i] = (1.0f - a) + select<F>(colored, base_color[i] * of_color, a);
  return f;
}

template <class D>
VITRAIL_LANES D diffuse(D roughness, D flatness, D out, D in, D half) {
  const D weight_in = schlick_weight<D>(in), weight_out = schlick_weight<D>(out);
  const D lambert = (1.0 - weight_in / 2.0) * (1.0 - weight_out / 2.0);
  const D r = 2.0 * roughness * half * half;
  const D retro = r * (weight_in + weight_out + weight_in * weight_out * (r - 1.0));
  const D round = lambert + retro;
  const Mask<D> flattened = flatness != 0;
  if (!any(flattened)) return round;
  const D grazing = r / 2.0 - 1.0;
  const D fss = (1.0 + grazing * weight_in) * (1.0 + grazing * weight_out);
  const D flat = 1.25 * (fss * (1.0 / (in + out) - 0.5) + 0.5);
  return select<D>(flattened, round * (1.0 - flatness) + flat * flatness, round);
}

// Returns π·f/base of a base below microfacets of that roughness, behind which the index is eta ≥ 1. It gets
// the share of all light from a direction that the facets do not reflect, 1 − E (Kulla and Conty 2017).
// E = f₀·a + (1 − f₀)·b·y·(m + (1 − m)·y), y = (1 − cosine)^p, is a fit to GGX with separable masking: up to
// 75° within .009 for indices of 1.5 to 1.8. For an index of 1 it is 0.
template <class D>
VITRAIL_LANES D below(D roughness, D eta, D out, D in) {
  const D r2 = roughness * roughness, r3 = r2 * roughness, f0 = normal_reflectance<D>(eta);
  const D p = 2.865 + 0.0621 * (eta + 1.0) / lanes::max(eta - 1.0, fill<D>(1e-6)),
          m = 0.33 + 1.574 * r3 / (r3 + 0.0186), facing = f0 * (1.0 - 0.622 * r3),
          grazing = (1.0 - f0) / (1.0 + p * p * r2 * (0.959 + 2.697 * roughness));
  const auto kept = [&](D cosine) __attribute__((always_inline)) {
    const D y = quick_exp<D>(p * quick_log(lanes::max(1.0 - cosine, fill<D>(1e-9))));
    return 1.0 - facing - grazing * y * (m + (1.0 - m) * y);
  };
  // They are the means over the cosines of y and of y².
  const D one = 2.0 / ((p + 1.0) * (p + 2.0)), two = 1.0 / ((2.0 * p + 1.0) * (p + 1.0));
  return kept(out) * kept(in) / (1.0 - facing - grazing * (m * one + (1.0 - m) * two));
}

// They return GTR₁ (Burley 2012, Eq. 4), D(m) in sr⁻¹, and a sample of it with pdf D(m)·m.z. 0 < alpha < 1.
template <class D>
VITRAIL_LANES D gtr1(D alpha, Vector<D> m) {
  const D a2 = alpha * alpha;  // log α² < 0, the rest ≥ α²
  const D density = (a2 - 1.0) / (pi * quick_log(a2) * (1.0 + (a2 - 1.0) * m.z * m.z));
  return select<D>(m.z > 0, density, fill<D>(0));
}

template <class D>
VITRAIL_LANES Vector<D> sample_gtr1(D alpha, FloatsLike<D> u_x, FloatsLike<D> u_y) {
  const D a2 = alpha * alpha;
  const D power = quick_exp<D>(quick_log(a2) * (1.0 - to_doubles(u_y)));
  const D cos2 = lanes::clamp<D>((1.0 - power) / (1.0 - a2), 0.0, 1.0);
  const D sine = safe_sqrt(1.0 - cos2);
  const Circle<D> circle = quick_circle(to_doubles(u_x));
  return {sine * circle.cosine, sine * circle.sine, lanes::sqrt(cos2)};
}

}  // namespace principled
}  // namespace
}  // namespace vitrail::lanes
