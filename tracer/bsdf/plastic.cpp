// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/plastic.h"

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

double mean(const SampledSpectrum& s) {
  double sum = 0;
  for (float x : s.v) sum += static_cast<double>(x);
  return sum / hero_count;
}

// Of sampling the coat's reflection rather than the base, where it reflects `reflectance` (Mitsuba's choice).
template <class Plastic>
double specular_probability(const Plastic& bsdf, double reflectance) {
  const double s = reflectance * mean(bsdf.specular_reflectance);
  const double d = (1 - reflectance) * mean(bsdf.diffuse_reflectance);
  return s + d > 0 ? attainable(s / (s + d)) : 1;
}

// f/(T(out)·T(in)) of the base, times π.
template <class Plastic>
SampledSpectrum base(const Plastic& bsdf, double internal_reflectance) {
  const float r = static_cast<float>(internal_reflectance);
  const float inverse_eta2 = static_cast<float>(1 / (bsdf.eta * bsdf.eta));
  SampledSpectrum result = bsdf.diffuse_reflectance;
  for (float& rho : result.v) rho *= inverse_eta2 / (1 - r * (bsdf.nonlinear ? rho : 1));
  return result;
}

bool reflects(Vector3d out, Vector3d in) { return out.z > 0 && in.z > 0; }

double transmittance(const PlasticBsdf& bsdf, double cosine) {
  return 1 - fresnel_dielectric(std::min(cosine, 1.0), bsdf.eta);
}

double transmittance(const RoughPlasticBsdf& bsdf, double cosine) {
  constexpr int last = RoughPlasticTables::count - 1;
  const double x = std::clamp(cosine, 0.0, 1.0) * last;
  const int i = std::min(static_cast<int>(x), last - 1);
  const auto at = [&](int k) {
    return static_cast<double>(bsdf.tables->external_transmittance[static_cast<std::size_t>(k)]);
  };
  return at(i) + (x - i) * (at(i + 1) - at(i));
}

}  // namespace

BsdfValue eval(const PlasticBsdf& bsdf, Vector3d out, Vector3d in) {
  if (!reflects(out, in)) return {};
  const double t_out = transmittance(bsdf, out.z), t_in = transmittance(bsdf, in.z);
  const double value = t_out * t_in * in.z / pi;
  return {base(bsdf, bsdf.internal_reflectance) * static_cast<float>(value),
          (1 - specular_probability(bsdf, 1 - t_out)) * in.z / pi};
}

SampledSpectrum base_of(const PlasticBsdf& bsdf, double cosine_out) {
  return base(bsdf, bsdf.internal_reflectance) * static_cast<float>(transmittance(bsdf, cosine_out));
}

double pdf(const PlasticBsdf& bsdf, Vector3d out, Vector3d in) {
  if (!reflects(out, in)) return 0;
  return (1 - specular_probability(bsdf, 1 - transmittance(bsdf, out.z))) * in.z / pi;
}

std::optional<BsdfSample> sample(const PlasticBsdf& bsdf, Vector3d out, float u_lobe, Point2f u) {
  if (!(out.z > 0)) return std::nullopt;
  const double t_out = transmittance(bsdf, out.z);
  const double specular = specular_probability(bsdf, 1 - t_out);
  if (static_cast<double>(u_lobe) < specular)
    return BsdfSample{.in = {-out.x, -out.y, out.z},
                      .weight = bsdf.specular_reflectance * static_cast<float>((1 - t_out) / specular),
                      .specular = true};
  const Vector3d in = sample_cosine_hemisphere(u.x, u.y);
  if (!(in.z > 0)) return std::nullopt;
  const double weight = t_out * transmittance(bsdf, in.z) / (1 - specular);
  return BsdfSample{.in = in,
                    .weight = base(bsdf, bsdf.internal_reflectance) * static_cast<float>(weight),
                    .pdf = (1 - specular) * in.z / pi};
}

BsdfValue eval(const RoughPlasticBsdf& bsdf, Vector3d out, Vector3d in) {
  if (!reflects(out, in)) return {};
  const Vector3d m = normalize(out + in);
  const double facets = normal_density(bsdf.microfacets, m);
  const double area = visible_area(bsdf.microfacets, out);
  const double t_out = transmittance(bsdf, out.z);
  const double coat = fresnel_dielectric(std::min(dot(out, m), 1.0), bsdf.eta) * facets *
                      shadowing_over_cosines(bsdf.microfacets, out, area, in) * in.z / 4;
  const double diffuse = t_out * transmittance(bsdf, in.z) * in.z / pi;
  const double specular = specular_probability(bsdf, 1 - t_out);
  return {bsdf.specular_reflectance * static_cast<float>(coat) +
              base(bsdf, bsdf.tables->internal_reflectance) * static_cast<float>(diffuse),
          specular * facets / (4 * area) + (1 - specular) * in.z / pi};
}

double pdf(const RoughPlasticBsdf& bsdf, Vector3d out, Vector3d in) {
  if (!reflects(out, in)) return 0;
  const double facets = normal_density(bsdf.microfacets, normalize(out + in));
  const double specular = specular_probability(bsdf, 1 - transmittance(bsdf, out.z));
  return specular * facets / (4 * visible_area(bsdf.microfacets, out)) + (1 - specular) * in.z / pi;
}

std::optional<BsdfSample> sample(const RoughPlasticBsdf& bsdf, Vector3d out, float u_lobe, Point2f u) {
  if (!(out.z > 0)) return std::nullopt;
  const double specular = specular_probability(bsdf, 1 - transmittance(bsdf, out.z));
  const Vector3d in = static_cast<double>(u_lobe) < specular
                          ? mirror(out, sample_visible_normal(bsdf.microfacets, out, u))
                          : sample_cosine_hemisphere(u.x, u.y);
  const BsdfValue f = eval(bsdf, out, in);
  if (!(f.pdf > 1e-30)) return std::nullopt;
  return BsdfSample{.in = in, .weight = f.value * static_cast<float>(1 / f.pdf), .pdf = f.pdf};
}

}  // namespace vitrail
