// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"
#include "tracer/bsdf/microfacet.h"

namespace vitrail {

// A DielectricBsdf is the interface between two transparent media, seen from either side. It obeys Snell's
// and Fresnel's laws where its microfacets are smooth, else its facets obey them (Walter et al. 2007, Eqs. 20
// and 21). Transmitted radiance is divided by η². Light that facets scatter more than once is lost. A rough
// interface whose indices agree to 1e-6 lets light straight through.
struct DielectricBsdf {
  double eta = 1.5;  // index of refraction behind / in front, at the wavelength that leads the path
  Microfacets microfacets;
  SampledSpectrum reflectance_factor = filled(1), transmittance_factor = filled(1);
};

// It is a dielectric sheet whose two smooth faces are too close to tell apart. With all reflections between
// them it mirrors R′ = R + T²R·(1 + R² + …) = 2R/(1 + R) of light of either polarisation. The rest goes
// straight through.
struct ThinDielectricBsdf {
  SampledSpectrum eta = filled(1.5f);  // index of the sheet / of what surrounds it
  SampledSpectrum reflectance_factor = filled(1), transmittance_factor = filled(1);
  SampledSpectrum throughput = filled(1);  // of the path: guides its choice
};

// Returns whether a rough interface of that index lets light straight through.
inline bool goes_straight(double eta) { return eta > 1 - 1e-6 && eta < 1 + 1e-6; }

BsdfValue eval(const DielectricBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const DielectricBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const DielectricBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

BsdfValue eval(const ThinDielectricBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const ThinDielectricBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const ThinDielectricBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

// Returns the share of light of that Q/I (tracer/panes/polarization.h) that goes straight through a thin
// sheet. Shadow rays that pass the sheet need it.
SampledSpectrum straight_transmittance(const ThinDielectricBsdf& bsdf, double cosine, double q = 0);
// Returns the share that the sheet mirrors.
SampledSpectrum mirrored_share(const ThinDielectricBsdf& bsdf, double cosine, double q = 0);

}  // namespace vitrail
