// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

// Returns the unpolarised reflectance, in [0, 1], of a smooth interface with an absorbing material of index
// eta + i·k. Both are divided by the index in front, which does not absorb; they are ≥ 0 and not both 0. The
// cosine of incidence is in [0, 1] (Born & Wolf, §14.2).
double fresnel_conductor(double cosine, double eta, double k);

// Returns the same at each wavelength. eta and k are the metal's, and exterior_eta is the index in front of
// it.
SampledSpectrum fresnel_conductor(double cosine, const SampledSpectrum& eta, const SampledSpectrum& k,
                                  float exterior_eta = 1);

// Returns the reflectance of a smooth dielectric interface averaged over diffuse illumination: 2·∫ F(μ) μ dμ
// over [0, 1], to 1e-6. eta = index behind / index in front.
double fresnel_diffuse(double eta);

}  // namespace vitrail
