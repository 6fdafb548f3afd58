// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/conductor.h"

#include "tracer/bsdf/fresnel.h"

namespace vitrail {

namespace {

SampledSpectrum reflectance(const ConductorBsdf& bsdf, double cosine) {
  if (bsdf.perfect) return bsdf.factor;
  return bsdf.factor * fresnel_conductor(std::min(cosine, 1.0), bsdf.eta, bsdf.k);
}

bool scatters(const ConductorBsdf& bsdf, Vector3d out, Vector3d in) {
  return out.z > 0 && in.z > 0 && !bsdf.microfacets.smooth();
}

}  // namespace

BsdfValue eval(const ConductorBsdf& bsdf, Vector3d out, Vector3d in) {
  if (!scatters(bsdf, out, in)) return {};
  const Vector3d m = normalize(out + in);
  const double facets = normal_density(bsdf.microfacets, m);
  if (facets <= 0) return {};
  const double area = visible_area(bsdf.microfacets, out);
  const double value = facets * shadowing_over_cosines(bsdf.microfacets, out, area, in) * in.z / 4;
  return {reflectance(bsdf, dot(out, m)) * static_cast<float>(value), facets / (4 * area)};
}

// Visible normals, reflected: dm/d in = 1/(4·out·m).
double pdf(const ConductorBsdf& bsdf, Vector3d out, Vector3d in) {
  if (!scatters(bsdf, out, in)) return 0;
  return normal_density(bsdf.microfacets, normalize(out + in)) / (4 * visible_area(bsdf.microfacets, out));
}

std::optional<BsdfSample> sample(const ConductorBsdf& bsdf, Vector3d out, float, Point2f u) {
  if (!(out.z > 0)) return std::nullopt;
  const Microfacets& mf = bsdf.microfacets;
  if (mf.smooth())
    return BsdfSample{.in = {-out.x, -out.y, out.z}, .weight = reflectance(bsdf, out.z), .specular = true};
  const Vector3d m = sample_visible_normal(mf, out, u);
  const Vector3d in = mirror(out, m);
  const double area = visible_area(mf, out), probability = normal_density(mf, m) / (4 * area);
  if (!(in.z > 0 && dot(out, m) > 0 && probability > 0)) return std::nullopt;
  const double seen = shadowing_over_cosines(mf, out, area, in) * in.z * area;  // G₂/G₁
  return BsdfSample{
      .in = in, .weight = reflectance(bsdf, dot(out, m)) * static_cast<float>(seen), .pdf = probability};
}

}  // namespace vitrail
