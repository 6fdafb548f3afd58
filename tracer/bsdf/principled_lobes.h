// SPDX-License-Identifier: Apache-2.0
// Both principled models are made of these functions.
#pragma once

#include "tracer/bsdf/bsdf.h"
#include "tracer/bsdf/microfacet.h"

namespace vitrail::principled {

// Returns (1 − cosθ)⁵ (Schlick 1994); 0 ≤ cosine ≤ 1.
double schlick_weight(double cosine);

// The two compute F₀ + (1 − F₀)·weight, with the weight of the angle on the side of the smaller index.
// eta = index behind / index in front.
double schlick_weight(double cosine, double eta);
SampledSpectrum schlick(const SampledSpectrum& normal_reflectance, double weight);

// Returns ((η − 1)/(η + 1))².
double normal_reflectance(double eta);

// Returns lerp(1, base_color/luminance, amount), 1 where the luminance is 0.
SampledSpectrum tint(const SampledSpectrum& base_color, double luminance, double amount);

Microfacets microfacets(double roughness, double anisotropic);

// `diffuse` returns π·f/base_color: diffuse and retro-reflection (Burley 2015, §5.3), and the flat form after
// Hanrahan and Krueger (Burley 2012, §5.3). The cosines are those of both directions, > 0, and of half the
// angle between them.
struct DiffuseCosines {
  double out, in, half;
};
double diffuse(double roughness, double flatness, DiffuseCosines cosines);

// Returns π·f/base_color of a base below such microfacets, behind which the index is eta ≥ 1. The base gets
// what the facets do not reflect (Kulla and Conty 2017). Cosines are > 0.
double below(double roughness, double eta, double out, double in);

}  // namespace vitrail::principled
