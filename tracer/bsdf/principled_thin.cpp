// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/bsdf/principled.h"
#include "tracer/bsdf/principled_lobes.h"

namespace vitrail {

namespace {

using namespace principled;

Microfacets reflecting_facets(const PrincipledThinBsdf& b) { return microfacets(b.roughness, b.anisotropic); }

// Narrower, as light bends little on its way through a sheet (Burley 2015, Fig. 15).
Microfacets transmitting_facets(const PrincipledThinBsdf& b) {
  return microfacets((0.65 * b.eta - 0.35) * b.roughness, b.anisotropic);
}

// Of the light, what meets each lobe: the first two share theirs by the Fresnel factor.
struct Parts {
  double reflected, transmitted, diffuse_reflected, diffuse_transmitted;
};

Parts parts(const PrincipledThinBsdf& b) {
  const double diffuse = 1 - b.spec_trans, through = b.diff_trans / 2;
  return {b.below ? 1 : b.spec_trans, b.spec_trans, diffuse * (1 - through), diffuse * through};
}

Parts lobe_weights(const PrincipledThinBsdf& b, double cosine) {
  Parts w = parts(b);
  const double color = std::max(0.01, static_cast<double>(max_value(b.base_color)));
  const double fresnel = std::clamp(fresnel_dielectric(std::min(1.0, cosine), b.eta), 0.15, 0.9);
  w.reflected *= fresnel;
  w.transmitted *= (1 - fresnel) * color;
  w.diffuse_reflected *= color + 0.3 * b.sheen;
  w.diffuse_transmitted *= color;
  const double scale = 1 / (w.reflected + w.transmitted + w.diffuse_reflected + w.diffuse_transmitted);
  return {w.reflected * scale, w.transmitted * scale, w.diffuse_reflected * scale,
          w.diffuse_transmitted * scale};
}

// Half vector of `out` and of `in` folded to the same side.
Vector3d folded_half(Vector3d out, Vector3d in) {
  return normalize(out + Vector3d{in.x, in.y, std::abs(in.z)});
}

double facets_value(const Microfacets& mf, Vector3d out, Vector3d in, Vector3d h) {
  return normal_density(mf, h) * shadowing_over_cosines(mf, out, in) * std::abs(in.z) / 4;
}

SampledSpectrum reflected(const PrincipledThinBsdf& b, Vector3d out, Vector3d in) {
  const Parts part = parts(b);
  const Vector3d h = folded_half(out, in);
  const double half = std::min(1.0, dot(out, h));
  SampledSpectrum value{};
  if (part.reflected > 0) {
    SampledSpectrum f =
        filled(static_cast<float>((1 - b.spec_tint) * fresnel_dielectric(std::max(0.0, half), b.eta)));
    if (b.spec_tint > 0)
      f = f + schlick(tint(b.base_color, b.luminance, 1) * static_cast<float>(normal_reflectance(b.eta)),
                      schlick_weight(half, b.eta)) *
                  static_cast<float>(b.spec_tint);
    value = f * static_cast<float>(part.reflected * facets_value(reflecting_facets(b), out, in, h));
  }
  const double f = b.below ? below(b.roughness, b.eta, out.z, in.z)
                           : diffuse(b.roughness, b.flatness, {out.z, in.z, half});
  value = value + b.base_color * static_cast<float>(part.diffuse_reflected * f * in.z / pi);
  if (b.sheen > 0)
    value = value + tint(b.base_color, b.luminance, b.sheen_tint) *
                        static_cast<float>(b.sheen * part.diffuse_reflected * schlick_weight(half) * in.z);
  return value;
}

SampledSpectrum transmitted(const PrincipledThinBsdf& b, Vector3d out, Vector3d in) {
  const Parts part = parts(b);
  double value = part.diffuse_transmitted * -in.z / pi;
  if (b.below && value > 0) value *= below(b.roughness, b.eta, out.z, -in.z);
  const Vector3d h = folded_half(out, in);
  const double half = std::min(1.0, dot(out, h));
  if (part.transmitted > 0 && dot(in, h) < 0)  // Mitsuba's: a facet is crossed from one side to the other
    value += part.transmitted * (1 - fresnel_dielectric(std::max(0.0, half), b.eta)) *
             facets_value(transmitting_facets(b), out, in, h);
  return b.base_color * static_cast<float>(value);
}

double pdf_above(const PrincipledThinBsdf& b, Vector3d out, Vector3d in) {
  const Parts w = lobe_weights(b, out.z);
  const bool reflects = in.z > 0;
  const double diffuse = (reflects ? w.diffuse_reflected : w.diffuse_transmitted) * std::abs(in.z) / pi;
  const double facets = reflects ? w.reflected : w.transmitted;
  const Vector3d h = folded_half(out, in);
  const double half = dot(out, h);
  if (!(facets > 0) || !(half > 0)) return diffuse;
  const Microfacets mf = reflects ? reflecting_facets(b) : transmitting_facets(b);
  return diffuse + facets * visible_normal_pdf(mf, out, h) / (4 * half);
}

}  // namespace

BsdfValue eval(const PrincipledThinBsdf& b, Vector3d out, Vector3d in) {
  if (out.z == 0 || in.z == 0) return {};
  if (out.z < 0) out = -out, in = -in;
  return {in.z > 0 ? reflected(b, out, in) : transmitted(b, out, in), pdf_above(b, out, in)};
}

double pdf(const PrincipledThinBsdf& b, Vector3d out, Vector3d in) {
  if (out.z == 0 || in.z == 0) return 0;
  return out.z > 0 ? pdf_above(b, out, in) : pdf_above(b, -out, -in);
}

std::optional<BsdfSample> sample(const PrincipledThinBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  if (out.z == 0) return std::nullopt;
  const Vector3d up = out.z > 0 ? out : -out;
  const Parts w = lobe_weights(b, up.z);
  const auto choice = static_cast<double>(u_lobe);
  Vector3d in;
  if (choice < w.reflected + w.transmitted) {
    const bool reflects = choice < w.reflected;
    in = mirror(up, sample_visible_normal(reflects ? reflecting_facets(b) : transmitting_facets(b), up, u));
    if (!(in.z > 0)) return std::nullopt;
    if (!reflects) in.z = -in.z;
  } else {
    in = sample_cosine_hemisphere(u.x, u.y);
    if (choice >= w.reflected + w.transmitted + w.diffuse_reflected && w.diffuse_transmitted > 0) in = -in;
  }
  const BsdfValue f = eval(b, up, in);
  if (!(f.pdf > 0)) return std::nullopt;
  return BsdfSample{
      .in = out.z > 0 ? in : -in, .weight = f.value * static_cast<float>(1 / f.pdf), .pdf = f.pdf};
}

}  // namespace vitrail
