// SPDX-License-Identifier: Apache-2.0
// These surfaces scatter light to all sides.
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"

namespace vitrail {

// It has f = reflectance/π (Lambert 1760).
struct LambertBsdf {
  SampledSpectrum reflectance;
};

// It has Lambertian facets in V-grooves (Oren & Nayar 1994, their qualitative model: Eq. 30 without
// interreflections):
//   f = ρ/π·(A + B·max(0, cos(φ_o − φ_i))·sin α·tan β), α = max(θ_o, θ_i), β = min(θ_o, θ_i),
//   A = 1 − σ²/(2(σ² + 0.33)), B = 0.45 σ²/(σ² + 0.09).
// Its albedo rises to ρ·(A + B/2) at grazing directions, up to 1.5 % above ρ for σ < 19°. ρ is held below the
// inverse of that, so that no more light leaves than comes.
struct OrenNayarBsdf {
  SampledSpectrum reflectance;
  double sigma_rad = 0;  // standard deviation of the slopes' angles, ≥ 0
};

// It is Lambertian to both sides. Reflectance and transmittance together ought not to exceed 1.
struct DiffuseTransmissionBsdf {
  SampledSpectrum reflectance, transmittance;
};

BsdfValue eval(const LambertBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const LambertBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const LambertBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

BsdfValue eval(const OrenNayarBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const OrenNayarBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const OrenNayarBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

BsdfValue eval(const DiffuseTransmissionBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const DiffuseTransmissionBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const DiffuseTransmissionBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
