// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/principled.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/bsdf/principled_lobes.h"

namespace vitrail {

namespace {

using namespace principled;

// What of a pair of directions and a model is needed more than once.
struct Pair {
  double diffuse, refraction;  // weights of the two models that metallic leaves
  double eta;                  // index across / index on the side of `out`
  bool front, reflects;
  Vector3d h;         // half vector, h.z ≥ 0
  bool facets_agree;  // both directions see their side of h
  double fresnel;
};

double refractive_eta(const PrincipledBsdf& b) { return b.spec_trans > 0 && b.eta == 1 ? 1.001 : b.eta; }

double clearcoat_alpha(const PrincipledBsdf& b) { return 0.1 + (0.001 - 0.1) * b.clearcoat_gloss; }

Pair make_pair(const PrincipledBsdf& b, Vector3d out, Vector3d in) {
  Pair p{};
  p.diffuse = (1 - b.metallic) * (1 - b.spec_trans);
  p.refraction = (1 - b.metallic) * b.spec_trans;
  p.front = out.z > 0;
  p.reflects = out.z * in.z > 0;
  p.eta = p.front ? refractive_eta(b) : 1 / refractive_eta(b);
  p.h = normalize(out + in * (p.reflects ? 1 : p.eta));
  if (p.h.z < 0) p.h = -p.h;
  const double side = p.front ? 1 : -1;
  p.facets_agree = dot(out, p.h) * side > 0 && dot(in, p.h) * (p.reflects ? side : -side) > 0;
  p.fresnel = fresnel_dielectric(std::min(1.0, std::abs(dot(out, p.h))), p.eta);
  return p;
}

struct LobeWeights {
  double diffuse, clearcoat, specular;  // sum 1
};

LobeWeights lobe_weights(const PrincipledBsdf& b, Vector3d out) {
  if (!(out.z > 0)) return {0, 0, 1};
  const double diffuse = (1 - b.metallic) * (1 - b.spec_trans);
  const double sheen = diffuse > 0 ? 0.3 * b.sheen * (1 - b.metallic) : 0;
  const double fresnel = std::max(0.15, fresnel_dielectric(std::min(1.0, out.z), refractive_eta(b)));
  LobeWeights w{.diffuse = diffuse * static_cast<double>(max_value(b.base_color)) + sheen,
                .clearcoat = 0.25 * b.clearcoat * std::max(0.15, schlick_weight(out.z)),
                .specular = 1 - diffuse * (1 - fresnel)};  // ≥ 0.15
  const double scale = 1 / (w.diffuse + w.clearcoat + w.specular);
  return {w.diffuse * scale, w.clearcoat * scale, w.specular * scale};
}

// Of the specular lobe's samples, the part that reflects.
double reflected_part(const Pair& p) { return p.front ? 1 - p.refraction * (1 - p.fresnel) : p.fresnel; }

SampledSpectrum specular_factor(const PrincipledBsdf& b, const Pair& p, double cosine) {
  if (!p.front) return filled(static_cast<float>(p.refraction * p.fresnel));
  const double weight = schlick_weight(std::min(1.0, cosine), p.eta), dielectric = 1 - b.metallic;
  SampledSpectrum f = filled(static_cast<float>(dielectric * (1 - b.spec_tint) * p.fresnel));
  if (b.metallic > 0) f = f + schlick(b.base_color, weight) * static_cast<float>(b.metallic);
  if (b.spec_tint > 0) {
    const SampledSpectrum tinted =
        tint(b.base_color, b.luminance, 1) * static_cast<float>(normal_reflectance(p.eta));
    f = f + schlick(tinted, weight) * static_cast<float>(dielectric * b.spec_tint);
  }
  return f;
}

// GGX's G₁ of width 1/4 times 1/cosθ, as 2/(c + √(c² + α²(1 − c²))).
double clearcoat_masking_over_cosine(double c) { return 2 / (c + std::sqrt(c * c + (1 - c * c) / 16)); }

double clearcoat(const PrincipledBsdf& b, const Pair& p, Vector3d out, Vector3d in) {
  const double weight = schlick_weight(std::min(1.0, dot(out, p.h)), p.eta);
  const double masked = clearcoat_masking_over_cosine(out.z) * clearcoat_masking_over_cosine(in.z);
  return 0.25 * b.clearcoat * (0.04 + 0.96 * weight) * gtr1(clearcoat_alpha(b), p.h) * masked * out.z * in.z *
         in.z;
}

SampledSpectrum reflected(const PrincipledBsdf& b, const Pair& p, Vector3d out, Vector3d in) {
  SampledSpectrum value{};
  if (p.facets_agree && p.fresnel > 0) {
    const Microfacets mf = microfacets(b.roughness, b.anisotropic);
    const double common = normal_density(mf, p.h) * shadowing_over_cosines(mf, out, in) * std::abs(in.z) / 4;
    value = specular_factor(b, p, std::abs(dot(out, p.h))) * static_cast<float>(common);
  }
  if (!p.front) return value;
  if (b.clearcoat > 0 && p.facets_agree) value = value + filled(static_cast<float>(clearcoat(b, p, out, in)));
  if (p.diffuse > 0) {
    const double half = dot(p.h, in);
    const double f = diffuse(b.roughness, b.flatness, {out.z, in.z, half});
    value = value + b.base_color * static_cast<float>(p.diffuse * f * in.z / pi);
    if (b.sheen > 0)
      value = value + tint(b.base_color, b.luminance, b.sheen_tint) *
                          static_cast<float>(b.sheen * (1 - b.metallic) * schlick_weight(half) * in.z);
  }
  return value;
}

SampledSpectrum refracted(const PrincipledBsdf& b, const Pair& p, Vector3d out, Vector3d in) {
  if (!(p.refraction > 0) || !p.facets_agree || p.fresnel >= 1) return {};
  const Microfacets mf = microfacets(b.roughness, b.anisotropic);
  const double out_h = dot(out, p.h), in_h = dot(in, p.h), denominator = out_h + p.eta * in_h;
  if (denominator == 0) return {};
  const double value = p.refraction * (1 - p.fresnel) * normal_density(mf, p.h) *
                       shadowing_over_cosines(mf, out, in) * std::abs(in.z * out_h * in_h) /
                       (denominator * denominator);
  SampledSpectrum color;
  for (int i = 0; i < hero_count; ++i) color[i] = std::sqrt(std::max(0.0f, b.base_color[i]));
  return color * static_cast<float>(value);
}

double pdf(const PrincipledBsdf& b, const Pair& p, Vector3d out, Vector3d in) {
  const LobeWeights w = lobe_weights(b, out);
  double sum = p.reflects ? w.diffuse * std::abs(in.z) / pi : 0;
  if (!p.facets_agree) return sum;
  const Microfacets mf = microfacets(b.roughness, b.anisotropic);
  const double out_h = dot(out, p.h), in_h = dot(in, p.h);
  const double normals = w.specular * visible_normal_pdf(mf, p.front ? out : -out, p.h);
  if (p.reflects)
    return sum + (normals * reflected_part(p) +
                  (w.clearcoat > 0 ? w.clearcoat * gtr1(clearcoat_alpha(b), p.h) * p.h.z : 0)) /
                     (4 * std::abs(out_h));
  const double denominator = out_h + p.eta * in_h;
  if (denominator == 0) return sum;
  return sum +
         normals * (1 - reflected_part(p)) * p.eta * p.eta * std::abs(in_h) / (denominator * denominator);
}

bool scatters(const PrincipledBsdf& b, Vector3d out, Vector3d in) {
  const bool refracts = b.spec_trans > 0 && b.metallic < 1;
  return out.z != 0 && in.z != 0 && (out.z > 0 || refracts) && (out.z * in.z > 0 || refracts);
}

}  // namespace

BsdfValue eval(const PrincipledBsdf& b, Vector3d out, Vector3d in) {
  if (!scatters(b, out, in)) return {};
  const Pair p = make_pair(b, out, in);
  return {p.reflects ? reflected(b, p, out, in) : refracted(b, p, out, in), pdf(b, p, out, in)};
}

double pdf(const PrincipledBsdf& b, Vector3d out, Vector3d in) {
  return scatters(b, out, in) ? pdf(b, make_pair(b, out, in), out, in) : 0;
}

std::optional<BsdfSample> sample(const PrincipledBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  if (out.z == 0) return std::nullopt;
  const LobeWeights w = lobe_weights(b, out);
  const auto choice = static_cast<double>(u_lobe);
  Vector3d in;
  if (choice < w.diffuse) {
    in = sample_cosine_hemisphere(u.x, u.y);
  } else if (choice < w.diffuse + w.clearcoat) {
    in = mirrored(out, sample_gtr1(clearcoat_alpha(b), u));
    if (!(in.z > 0)) return std::nullopt;
  } else {
    const bool front = out.z > 0;
    const Vector3d up = front ? out : -out;
    const Vector3d m = sample_visible_normal(microfacets(b.roughness, b.anisotropic), up, u);
    Pair p{};
    p.refraction = (1 - b.metallic) * b.spec_trans;
    p.front = front;
    p.eta = front ? refractive_eta(b) : 1 / refractive_eta(b);
    p.fresnel = fresnel_dielectric(std::clamp(dot(up, m), 0.0, 1.0), p.eta);
    const double rest = (choice - w.diffuse - w.clearcoat) / w.specular;  // specular ≥ 0.1
    if (rest < reflected_part(p))
      in = mirrored(out, m);
    else if (!refract(out, front ? m : -m, p.eta, in))
      return std::nullopt;
    if ((rest < reflected_part(p)) != (in.z * out.z > 0)) return std::nullopt;
  }
  const BsdfValue f = eval(b, out, in);
  if (!(f.pdf > 0)) return std::nullopt;
  return BsdfSample{.in = in, .weight = f.value * static_cast<float>(1 / f.pdf), .pdf = f.pdf};
}

}  // namespace vitrail
