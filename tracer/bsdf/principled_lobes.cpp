// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/principled_lobes.h"

#include <algorithm>
#include <cmath>

#include "tracer/bsdf/principled_lobes_lanes.h"

namespace vitrail::principled {

double schlick_weight(double cosine) { return lanes::principled::schlick_weight(cosine); }

double schlick_weight(double cosine, double eta) { return lanes::principled::schlick_weight(cosine, eta); }

SampledSpectrum schlick(const SampledSpectrum& normal_reflectance, double weight) {
  return lanes::lane(lanes::principled::schlick(lanes::fill<float>(normal_reflectance), weight), 0);
}

double normal_reflectance(double eta) { return lanes::principled::normal_reflectance(eta); }

SampledSpectrum tint(const SampledSpectrum& base_color, double luminance, double amount) {
  return lanes::lane(lanes::principled::tint(lanes::fill<float>(base_color), luminance, amount), 0);
}

Microfacets microfacets(double roughness, double anisotropic) {
  const double r2 = roughness * roughness, aspect = std::sqrt(1 - 0.9 * std::clamp(anisotropic, 0.0, 1.0));
  return make_microfacets(std::max(0.001, r2 / aspect), std::max(0.001, r2 * aspect),
                          Roughness::Distribution::ggx, Masking::separable);
}

double diffuse(double roughness, double flatness, DiffuseCosines c) {
  return lanes::principled::diffuse(roughness, flatness, c.out, c.in, c.half);
}

double below(double roughness, double eta, double out, double in) {
  return lanes::principled::below(roughness, eta, out, in);
}

}  // namespace vitrail::principled
