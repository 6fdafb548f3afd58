// SPDX-License-Identifier: Apache-2.0
// These are Disney's principled models (Burley 2012, 2015) as Mitsuba 3 has them: its `principled` and
// `principledthin`. With α = max(0.001, r²/a), max(0.001, r²·a), a = √(1 − 0.9·anisotropic), the values
// f·cosθ are sums of
//   (1 − metallic)(1 − spec_trans): base_color/π·lerp(diffuse + retro-reflection, flat, flatness), and sheen;
//   GGX reflection whose Fresnel factor blends the exact dielectric one, and Schlick's of the base colour
//   (metallic) and of the tinted reflectance at normal incidence;
//   0.25·clearcoat: GTR₁ of width lerp(0.1, 0.001, gloss), Schlick's F₀ = 0.04;
//   (1 − metallic)·spec_trans·√base_color: GGX refraction.
// The diffuse part with `below` is Lambert's, of the light that the GGX reflection leaves
// (principled::below), as in glTF. The models are not reciprocal. The refraction differs by more than 1/η²
// (Fresnel factors of Schlick's kind depend on the side), and the reflection behind has no metal. What
// reflects at the front is reciprocal.
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"

namespace vitrail {

// Parameters are in [0, 1] but for eta > 0, index behind / index in front. An eta of 1 is taken as 1.001
// where light is refracted. Below the surface the model only refracts and reflects the refracted light.
struct PrincipledBsdf {
  SampledSpectrum base_color;
  double luminance = 1;  // of base_color at all wavelengths: tints are base_color/luminance
  double eta = 1.5;
  double roughness = 0.5, anisotropic = 0, metallic = 0, spec_trans = 0, spec_tint = 0, sheen = 0,
         sheen_tint = 0, flatness = 0, clearcoat = 0, clearcoat_gloss = 0;
  bool below = false;
};

// It is a sheet, the same from either side. diff_trans, in [0, 2], is twice the part of the diffuse light
// that goes through.
struct PrincipledThinBsdf {
  SampledSpectrum base_color;
  double luminance = 1;
  double eta = 1.5;
  double roughness = 0.5, anisotropic = 0, spec_trans = 0, spec_tint = 0, sheen = 0, sheen_tint = 0,
         flatness = 0, diff_trans = 0;
  bool below = false;
};

BsdfValue eval(const PrincipledBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const PrincipledBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const PrincipledBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

BsdfValue eval(const PrincipledThinBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const PrincipledThinBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const PrincipledThinBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
