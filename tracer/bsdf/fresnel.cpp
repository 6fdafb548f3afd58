// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/fresnel.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/fresnel_lanes.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

double fresnel_conductor(double cosine, double eta, double k) {
  return lanes::fresnel_conductor(cosine, eta, k);
}

SampledSpectrum fresnel_conductor(double cosine, const SampledSpectrum& eta, const SampledSpectrum& k,
                                  float exterior_eta) {
  const double scale = 1 / static_cast<double>(exterior_eta);
  SampledSpectrum result;
  for (int i = 0; i < hero_count; ++i)
    result[i] = static_cast<float>(
        fresnel_conductor(cosine, static_cast<double>(eta[i]) * scale, static_cast<double>(k[i]) * scale));
  return result;
}

double fresnel_diffuse(double eta) {
  if (eta == 1) return 0;
  // In terms of the smaller of the two sines' complements the integrand is smooth: μ = √(1 − s²), with the
  // part under total internal reflection (1 − eta² for eta < 1) exact.
  const double inside = std::min(1.0, eta * eta);  // of sin², where light gets through
  constexpr int steps = 1024;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    // sin² = inside·(1 − q²), d(sin²) = −2·inside·q dq: no square-root singularity at the end.
    const double q = (i + 0.5) / steps;
    sum += fresnel_dielectric(safe_sqrt(1 - inside * (1 - q * q)), eta) * 2 * q;
  }
  return inside * sum / steps + (1 - inside);
}

}  // namespace vitrail
