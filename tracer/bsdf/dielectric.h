// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"
#include "tracer/bsdf/microfacet.h"

namespace vitrail {

// The interface between two transparent media, seen from either side: Snell's and Fresnel's laws where its
// microfacets are smooth, else facets that obey them (Walter et al. 2007, Eqs. 20 and 21). Transmitted
// radiance is divided by η². Light that facets scatter more than once is lost.
// A rough interface whose indices agree to 1e-6 lets light straight through.
struct DielectricBsdf {
  double eta = 1.5;  // index of refraction behind / in front, at the wavelength that leads the path
  Microfacets microfacets;
  SampledSpectrum reflectance_factor = filled(1), transmittance_factor = filled(1);
};

// A sheet of it whose two smooth faces are too close to tell apart. With all reflections between them
// R′ = R + T²R·(1 + R² + …) = 2R/(1 + R) of light of either polarisation, and the rest goes straight through.
struct ThinDielectricBsdf {
  SampledSpectrum eta = filled(1.5f);  // index of the sheet / of what surrounds it
  SampledSpectrum reflectance_factor = filled(1), transmittance_factor = filled(1);
  SampledSpectrum throughput = filled(1);  // of the path: guides its choice
};

// Whether a rough interface of that index lets light straight through.
inline bool goes_straight(double eta) { return eta > 1 - 1e-6 && eta < 1 + 1e-6; }

BsdfValue eval(const DielectricBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const DielectricBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const DielectricBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

BsdfValue eval(const ThinDielectricBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const ThinDielectricBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const ThinDielectricBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

// What goes straight through a thin sheet, for shadow rays that look for it, of light of that Q/I
// (tracer/panes/polarization.h).
SampledSpectrum straight_transmittance(const ThinDielectricBsdf& bsdf, double cosine, double q = 0);
// And what it mirrors.
SampledSpectrum mirrored_share(const ThinDielectricBsdf& bsdf, double cosine, double q = 0);

}  // namespace vitrail
