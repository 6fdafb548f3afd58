// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/layered_base.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

bool above(Vector3d out, Vector3d in) { return out.z > 0 && in.z > 0; }

SampledSpectrum reflectance(const ConductorBase& b, double cosine) {
  return fresnel_conductor(std::clamp(cosine, 0.0, 1.0), b.eta, b.k, static_cast<float>(b.interface_eta));
}

}  // namespace

SampledSpectrum base_value(const LambertBase& b, Vector3d out, Vector3d in) {
  return above(out, in) ? b.reflectance * static_cast<float>(1 / pi) : SampledSpectrum{};
}

double base_pdf(const LambertBase&, Vector3d out, Vector3d in) { return above(out, in) ? in.z / pi : 0; }

std::optional<BaseSample> sample_base(const LambertBase& b, Vector3d out, Point2f u) {
  const Vector3d in = sample_cosine_hemisphere(u.x, u.y);
  if (!above(out, in)) return std::nullopt;
  return BaseSample{in, b.reflectance, in.z / pi};
}

SampledSpectrum base_value(const ConductorBase& b, Vector3d out, Vector3d in) {
  if (b.smooth() || !above(out, in)) return {};
  const Vector3d h = normalize(out + in);  // h.z > 0
  constexpr double most = 1e30;            // where both directions graze
  return reflectance(b, dot(out, h)) *
         static_cast<float>(
             std::min(most, normal_density(b.facets, h) * shadowing_over_cosines(b.facets, out, in) / 4));
}

double base_pdf(const ConductorBase& b, Vector3d out, Vector3d in) {
  if (b.smooth() || !above(out, in)) return 0;
  const Vector3d h = normalize(out + in);
  const double half = dot(out, h);
  return half > 0 ? visible_normal_pdf(b.facets, out, h) / (4 * half) : 0;
}

std::optional<BaseSample> sample_base(const ConductorBase& b, Vector3d out, Point2f u) {
  if (!(out.z > 0)) return std::nullopt;
  if (b.smooth()) return BaseSample{{-out.x, -out.y, out.z}, reflectance(b, out.z), 1};
  const Vector3d m = sample_visible_normal(b.facets, out, u);
  const Vector3d in = m * (2 * dot(out, m)) - out;
  const double density = base_pdf(b, out, in);
  if (!(in.z > 0) || !(density > 0)) return std::nullopt;
  const double shadowing = shadowing_over_cosines(b.facets, out, in) * in.z * visible_area(b.facets, out);
  return BaseSample{in, reflectance(b, dot(out, m)) * static_cast<float>(shadowing), density};
}

}  // namespace vitrail
