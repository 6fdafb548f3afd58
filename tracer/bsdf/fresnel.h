// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

// Unpolarised reflectance of a smooth interface with an absorbing material of index eta + i·k, both divided
// by the index in front (which does not absorb); cosine of incidence in [0, 1], eta and k ≥ 0, not both 0
// (Born & Wolf, §14.2). In [0, 1].
double fresnel_conductor(double cosine, double eta, double k);

// The same at each wavelength; eta and k of the metal, exterior_eta in front of it.
SampledSpectrum fresnel_conductor(double cosine, const SampledSpectrum& eta, const SampledSpectrum& k,
                                  float exterior_eta = 1);

// Reflectance of a smooth dielectric interface averaged over diffuse illumination: 2·∫ F(μ) μ dμ over [0, 1],
// to 1e-6; eta = index behind / index in front.
double fresnel_diffuse(double eta);

}  // namespace vitrail
