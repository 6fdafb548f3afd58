// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/principled_lobes.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"

namespace vitrail::principled {

double schlick_weight(double cosine) {
  const double m = std::clamp(1 - cosine, 0.0, 1.0);
  return m * m * (m * m) * m;
}

double schlick_weight(double cosine, double eta) {
  if (eta > 1) return schlick_weight(cosine);
  return schlick_weight(safe_sqrt(1 - (1 - cosine * cosine) / (eta * eta)));
}

SampledSpectrum schlick(const SampledSpectrum& normal_reflectance, double weight) {
  const auto w = static_cast<float>(weight);
  return normal_reflectance * (1 - w) + filled(w);
}

double normal_reflectance(double eta) {
  const double r = (eta - 1) / (eta + 1);
  return r * r;
}

SampledSpectrum tint(const SampledSpectrum& base_color, double luminance, double amount) {
  const auto a = static_cast<float>(amount);
  return filled(1 - a) + (luminance > 0 ? base_color * static_cast<float>(amount / luminance) : filled(a));
}

Microfacets microfacets(double roughness, double anisotropic) {
  const double r2 = roughness * roughness, aspect = std::sqrt(1 - 0.9 * std::clamp(anisotropic, 0.0, 1.0));
  return make_microfacets(std::max(0.001, r2 / aspect), std::max(0.001, r2 * aspect),
                          Roughness::Distribution::ggx, Masking::separable);
}

double diffuse(double roughness, double flatness, DiffuseCosines c) {
  const double weight_in = schlick_weight(c.in), weight_out = schlick_weight(c.out);
  const double lambert = (1 - weight_in / 2) * (1 - weight_out / 2);
  const double r = 2 * roughness * c.half * c.half;
  const double retro = r * (weight_in + weight_out + weight_in * weight_out * (r - 1));
  if (flatness == 0) return lambert + retro;
  const double grazing = r / 2 - 1;
  const double fss = (1 + grazing * weight_in) * (1 + grazing * weight_out);
  const double flat = 1.25 * (fss * (1 / (c.in + c.out) - 0.5) + 0.5);
  return (lambert + retro) * (1 - flatness) + flat * flatness;
}

double gtr1(double alpha, Vector3d m) {
  if (!(m.z > 0)) return 0;
  const double a2 = alpha * alpha;
  return (a2 - 1) / (pi * portable_log(a2) * (1 + (a2 - 1) * m.z * m.z));  // log α² < 0, the rest ≥ α²
}

Vector3d sample_gtr1(double alpha, Point2f u) {
  const double a2 = alpha * alpha, phi = 2 * static_cast<double>(u.x);
  const double cos2 = std::clamp((1 - portable_pow(a2, 1 - static_cast<double>(u.y))) / (1 - a2), 0.0, 1.0);
  const double sine = safe_sqrt(1 - cos2);
  return {sine * sin_pi(phi + 0.5), sine * sin_pi(phi), std::sqrt(cos2)};
}

}  // namespace vitrail::principled
