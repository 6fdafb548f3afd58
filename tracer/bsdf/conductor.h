// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"
#include "tracer/bsdf/microfacet.h"

namespace vitrail {

// A ConductorBsdf is a metal. It is a mirror where its microfacets are smooth, else it has facets that are
// mirrors (Torrance & Sparrow 1967; Walter et al. 2007, Eq. 20):
// f = F(out·m)·D(m)·G₂(out, in)/(4·out.z·in.z), m halfway between the two.
// Light that facets scatter more than once is lost: all but 1 − ln 2 of it at α = 1 (GGX, seen from above).
struct ConductorBsdf {
  Microfacets microfacets;
  SampledSpectrum eta, k;              // index eta + i·k, divided by that of what is in front
  SampledSpectrum factor = filled(1);  // of the reflectance; strays from physics where it is not 1
  bool perfect = false;                // reflects everything: eta and k mean nothing
};

BsdfValue eval(const ConductorBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const ConductorBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const ConductorBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
