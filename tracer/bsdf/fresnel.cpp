// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/fresnel.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

double fresnel_conductor(double cosine, double eta, double k) {
  const double cos2 = cosine * cosine, sin2 = 1 - cos2;
  // (a + i·b)² = (eta + i·k)² − sin²θ: the index times the cosine of the complex angle of refraction.
  const double real = eta * eta - k * k - sin2, imaginary = 2 * eta * k;
  const double modulus = std::sqrt(real * real + imaginary * imaginary);  // a² + b²
  const double a = safe_sqrt((modulus + real) / 2);
  const double s_sum = modulus + cos2, s_difference = 2 * a * cosine;
  const double p_sum = modulus * cos2 + sin2 * sin2, p_difference = s_difference * sin2;
  if (!(s_sum + s_difference > 0)) return 1;  // cosine = 0 where the indices match
  const double s = (s_sum - s_difference) / (s_sum + s_difference);
  // At normal incidence both polarisations agree, and p_sum may vanish only with cosine.
  const double p_over_s = p_sum + p_difference > 0 ? (p_sum - p_difference) / (p_sum + p_difference) : 1;
  return std::clamp(s * (1 + p_over_s) / 2, 0.0, 1.0);
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
