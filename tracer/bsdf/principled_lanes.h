// SPDX-License-Identifier: Apache-2.0
// This file has vitrail::PrincipledBsdf of principled.h, for any number of lanes.
#pragma once

#include "tracer/bsdf/bsdf_lanes.h"
#include "tracer/bsdf/principled_lobes_lanes.h"

namespace vitrail::lanes {
namespace {

// A lane without a lobe has 0 for the lobe's amount.
template <class D>
struct Principled {
  Four<FloatsLike<D>> base_color;
  D luminance, eta, roughness, metallic, spec_trans, spec_tint, sheen, sheen_tint, flatness, clearcoat,
      clearcoat_gloss;
  Mask<D> below;
  Microfacets<D> microfacets;
};

namespace principled {

// They return the parts that metallic leaves to the diffuse and the refracting model.
template <class D>
VITRAIL_LANES D diffuse_part(const Principled<D>& b) {
  return (1.0 - b.metallic) * (1.0 - b.spec_trans);
}
template <class D>
VITRAIL_LANES D refracted_part(const Principled<D>& b) {
  return (1.0 - b.metallic) * b.spec_trans;
}

template <class D>
VITRAIL_LANES D refractive_eta(const Principled<D>& b) {
  return select<D>((b.spec_trans > 0) & (b.eta == 1), fill<D>(1.001), b.eta);
}

template <class D>
VITRAIL_LANES D clearcoat_alpha(const Principled<D>& b) {
  return 0.1 + (0.001 - 0.1) * b.clearcoat_gloss;
}

// They are the probabilities of sampling each lobe; their sum is 1.
template <class D>
struct LobeWeights {
  D diffuse, clearcoat, specular;
};

template <class D>
VITRAIL_LANES LobeWeights<D> lobe_weights(const Principled<D>& b, D cosine) {
  const D none = fill<D>(0), diffuse = diffuse_part(b);
  const D sheen = select<D>(diffuse > 0, 0.3 * b.sheen * (1.0 - b.metallic), none);
  const D fresnel =
      lanes::max(fill<D>(0.15), fresnel_dielectric<D>(lanes::min(fill<D>(1), cosine), refractive_eta(b)));
  const D brightest = to_doubles(greatest(b.base_color));
  const D by_diffuse = diffuse * brightest + sheen,
          by_clearcoat = 0.25 * b.clearcoat * lanes::max(fill<D>(0.15), schlick_weight<D>(cosine)),
          by_specular = 1.0 - diffuse * (1.0 - fresnel);  // ≥ 0.15
  const D scale = 1.0 / (by_diffuse + by_clearcoat + by_specular);
  const Mask<D> front = cosine > 0;
  return {select<D>(front, by_diffuse * scale, none), select<D>(front, by_clearcoat * scale, none),
          select<D>(front, by_specular * scale, fill<D>(1))};
}

// It holds what is needed of a pair of directions more than once.
template <class D>
struct Pair {
  D eta;  // index across / index on the side of `out`
  Mask<D> front, reflects;
  Vector<D> h;           // half vector, h.z ≥ 0
  D out_h, in_h;         // cosines to it, positive on its side
  Mask<D> facets_agree;  // both directions see their side of h
  D fresnel;
  D density, area;  // of normals h; of facets that `out` sees
};

// Returns what depends on the side of `out` alone, without the half vector and the members that depend on it.
template <class D>
VITRAIL_LANES Pair<D> pair_at(const Principled<D>& b, Vector<D> out) {
  Pair<D> p;
  p.front = out.z > 0;
  p.eta = refractive_eta(b);
  p.eta = select<D>(p.front, p.eta, 1.0 / p.eta);
  p.area = visible_area(b.microfacets, select<D>(p.front, out, -out));
  return p;
}

template <class D>
VITRAIL_LANES Pair<D> pair_of(const Principled<D>& b, Vector<D> out, Vector<D> in) {
  Pair<D> p = pair_at(b, out);
  p.reflects = out.z * in.z > 0;
  p.h = normalize(out + in * select<D>(p.reflects, fill<D>(1), p.eta));
  p.h = select<D>(p.h.z < 0, -p.h, p.h);
  p.out_h = dot(out, p.h), p.in_h = dot(in, p.h);
  const D side = select<D>(p.front, fill<D>(1), fill<D>(-1));
  p.facets_agree = (p.out_h * side > 0) & (p.in_h * select<D>(p.reflects, side, -side) > 0);
  p.fresnel = fresnel_dielectric<D>(lanes::min(fill<D>(1), abs(p.out_h)), p.eta);
  p.density = normal_density(b.microfacets, p.h);
  return p;
}

// Returns the part of the specular lobe's samples that reflects.
template <class D>
VITRAIL_LANES D reflected_part(const Principled<D>& b, const Pair<D>& p) {
  return select<D>(p.front, 1.0 - refracted_part(b) * (1.0 - p.fresnel), p.fresnel);
}

template <class D>
VITRAIL_LANES Four<FloatsLike<D>> specular_factor(const Principled<D>& b, const Pair<D>& p) {
  using F = FloatsLike<D>;
  const D weight = schlick_weight<D>(lanes::min(fill<D>(1), abs(p.out_h)), p.eta),
          dielectric = 1.0 - b.metallic;
  const F plain = to_floats(dielectric * (1.0 - b.spec_tint) * p.fresnel);
  Four<F> f{{plain, plain, plain, plain}};
  if (any(b.metallic > 0)) {
    const Four<F> metal = schlick<D>(b.base_color, weight);
    const F amount = to_floats(b.metallic);
    for (int i = 0; i < 4; ++i) f[i] = f[i] + metal[i] * amount;
  }
  if (any(b.spec_tint > 0)) {
    Four<F> tinted = tint<D>(b.base_color, b.luminance, fill<D>(1));
    const F normal = to_floats(normal_reflectance<D>(p.eta)), amount = to_floats(dielectric * b.spec_tint);
    for (int i = 0; i < 4; ++i) tinted[i] = tinted[i] * normal;
    tinted = schlick<D>(tinted, weight);
    for (int i = 0; i < 4; ++i) f[i] = f[i] + tinted[i] * amount;
  }
  const F behind = to_floats(refracted_part(b) * p.fresnel);
  const Mask<F> front = mask_for<F>(p.front);
  for (int i = 0; i < 4; ++i) f[i] = select<F>(front, f[i], behind);
  return f;
}

// Returns GGX's G₁ of width 1/4 times 1/cosθ, as 2/(c + √(c² + α²(1 − c²))).
template <class D>
VITRAIL_LANES D clearcoat_masking_over_cosine(D c) {
  return 2.0 / (c + lanes::sqrt(c * c + (1.0 - c * c) / 16.0));
}

template <class D>
VITRAIL_LANES D clearcoat(const Principled<D>& b, const Pair<D>& p, D out_z, D in_z) {
  const D weight = schlick_weight<D>(lanes::min(fill<D>(1), p.out_h), p.eta);
  const D masked = clearcoat_masking_over_cosine(out_z) * clearcoat_masking_over_cosine(in_z);
  return 0.25 * b.clearcoat * (0.04 + 0.96 * weight) * gtr1(clearcoat_alpha(b), p.h) * masked * out_z * in_z *
         in_z;
}

// `facets` is D·G₂/(|out.z|·|in.z|)·|in.z|.
template <class D>
VITRAIL_LANES Four<FloatsLike<D>> reflected(const Principled<D>& b, const Pair<D>& p, D facets, D out_z,
                                            D in_z) {
  using F = FloatsLike<D>;
  Four<F> value = specular_factor(b, p);
  const F common = to_floats(select<D>(p.facets_agree & (p.fresnel > 0), facets / 4.0, fill<D>(0)));
  for (int i = 0; i < 4; ++i) value[i] = value[i] * common;
  const Mask<D> coated = p.front & p.facets_agree & (b.clearcoat > 0);
  if (any(coated)) {
    const F coat = to_floats(select<D>(coated, clearcoat(b, p, out_z, in_z), fill<D>(0)));
    for (int i = 0; i < 4; ++i) value[i] = value[i] + coat;
  }
  const D part = diffuse_part(b);
  const Mask<D> diffuses = p.front & (part > 0);
  if (!any(diffuses)) return value;
  D f = fill<D>(0);
  if (!all(b.below)) f = diffuse<D>(b.roughness, b.flatness, out_z, in_z, p.in_h);
  if (any(b.below)) f = select<D>(b.below, below<D>(b.roughness, p.eta, out_z, in_z), f);
  const F base = to_floats(select<D>(diffuses, part * f * in_z / pi, fill<D>(0)));
  for (int i = 0; i < 4; ++i) value[i] = value[i] + b.base_color[i] * base;
  if (!any(diffuses & (b.sheen > 0))) return value;
  const Four<F> color = tint<D>(b.base_color, b.luminance, b.sheen_tint);
  const D amount = b.sheen * (1.0 - b.metallic) * schlick_weight<D>(p.in_h) * in_z;
  const F sheen = to_floats(select<D>(diffuses, amount, fill<D>(0)));
  for (int i = 0; i < 4; ++i) value[i] = value[i] + color[i] * sheen;
  return value;
}

template <class D>
VITRAIL_LANES Four<FloatsLike<D>> refracted(const Principled<D>& b, const Pair<D>& p, D facets) {
  using F = FloatsLike<D>;
  const D denominator = p.out_h + p.eta * p.in_h;
  const Mask<D> passes = (refracted_part(b) > 0) & p.facets_agree & (p.fresnel < 1) & (denominator != 0);
  const D value =
      refracted_part(b) * (1.0 - p.fresnel) * facets * abs(p.out_h * p.in_h) / (denominator * denominator);
  const F amount = to_floats(select<D>(passes, value, fill<D>(0)));
  Four<F> f;
  for (int i = 0; i < 4; ++i)
    f[i] = to_floats(lanes::sqrt(to_doubles(lanes::max(b.base_color[i], fill<F>(0))))) * amount;
  return f;
}

template <class D>
VITRAIL_LANES D pdf(const Principled<D>& b, const Pair<D>& p, D out_z, D in_z) {
  const LobeWeights<D> w = lobe_weights<D>(b, out_z);
  const D none = fill<D>(0), normals = w.specular * p.density / p.area;
  D reflects = normals * reflected_part(b, p);
  if (any(b.clearcoat > 0))
    reflects = reflects + w.clearcoat * gtr1(clearcoat_alpha(b), p.h) * p.h.z / abs(p.out_h);
  D by_facets = reflects / 4.0;
  if (!all(p.reflects)) {
    const D denominator = p.out_h + p.eta * p.in_h;
    const D through = normals * abs(p.out_h) * (1.0 - reflected_part(b, p)) * p.eta * p.eta * abs(p.in_h) /
                      (denominator * denominator);
    by_facets = select<D>(p.reflects, by_facets, select<D>(denominator != 0, through, none));
  }
  return select<D>(p.reflects, w.diffuse * abs(in_z) / pi, none) + select<D>(p.facets_agree, by_facets, none);
}

template <class D>
VITRAIL_LANES Mask<D> scatters(const Principled<D>& b, D out_z, D in_z) {
  const Mask<D> refracts = (b.spec_trans > 0) & (b.metallic < 1);
  return (out_z != 0) & (in_z != 0) & (refracts | ((out_z > 0) & (in_z > 0)));
}

}  // namespace principled

template <class D>
VITRAIL_LANES BsdfValue<D> eval(const Principled<D>& b, Vector<D> out, Vector<D> in) {
  using F = FloatsLike<D>;
  const principled::Pair<D> p = principled::pair_of(b, out, in);
  const Vector<D> above = select<D>(p.front, out, -out);
  const D facets = p.density * shadowing_over_cosines(b.microfacets, above, p.area, in) * abs(in.z);
  BsdfValue<D> f{principled::reflected<D>(b, p, facets, out.z, in.z), principled::pdf<D>(b, p, out.z, in.z)};
  if (!all(p.reflects)) {
    const Four<F> refracted = principled::refracted(b, p, facets);
    const Mask<F> reflects = mask_for<F>(p.reflects);
    for (int i = 0; i < 4; ++i) f.value[i] = select<F>(reflects, f.value[i], refracted[i]);
  }
  return detail::where<D>(principled::scatters<D>(b, out.z, in.z), f);
}

template <class D>
VITRAIL_LANES BsdfSample<D> sample(const Principled<D>& b, Vector<D> out, FloatsLike<D> u_lobe,
                                   FloatsLike<D> u_x, FloatsLike<D> u_y) {
  const principled::LobeWeights<D> w = principled::lobe_weights<D>(b, out.z);
  const D choice = to_doubles(u_lobe);
  const Mask<D> diffuse = choice < w.diffuse, coat = no(diffuse) & (choice < w.diffuse + w.clearcoat);
  const Mask<D> specular = no(diffuse | coat);
  Mask<D> valid = out.z != 0;
  Vector<D> in = sample_cosine_hemisphere(u_x, u_y);
  if (any(coat)) {
    in = select<D>(coat, mirror(out, principled::sample_gtr1<D>(principled::clearcoat_alpha(b), u_x, u_y)),
                   in);
    valid = valid & (no(coat) | (in.z > 0));
  }
  if (any(specular)) {
    principled::Pair<D> p = principled::pair_at(b, out);
    const Vector<D> above = select<D>(p.front, out, -out);
    const Vector<D> m = sample_visible_normal(b.microfacets, above, u_x, u_y);
    p.fresnel = fresnel_dielectric<D>(lanes::clamp<D>(dot(above, m), 0.0, 1.0), p.eta);
    const D rest = (choice - w.diffuse - w.clearcoat) / w.specular;  // specular ≥ 0.1
    const Mask<D> reflects = (rest < principled::reflected_part(b, p)) | (principled::refracted_part(b) == 0);
    Vector<D> to = mirror(out, m), through = to;
    Mask<D> arrives = to.z * out.z > 0;
    if (!all(reflects | no(specular))) {
      const Mask<D> passes = refract(out, select<D>(p.front, m, -m), p.eta, through);
      arrives = (reflects & arrives) | (no(reflects) & passes & no(through.z * out.z > 0));
      to = select<D>(reflects, to, through);
    }
    in = select<D>(specular, to, in);
    valid = valid & (no(specular) | arrives);
  }
  const BsdfValue<D> f = eval(b, out, in);
  BsdfSample<D> s;
  s.in = in, s.pdf = f.pdf, s.weight = f.value;
  for (int i = 0; i < 4; ++i) s.weight[i] = s.weight[i] * to_floats(1.0 / f.pdf);
  s.scatters = valid & (f.pdf > 0);
  s.specular = Mask<D>{};
  return s;
}

}  // namespace
}  // namespace vitrail::lanes
