// SPDX-License-Identifier: Apache-2.0
// What may lie under a coating. Directions are above it: z > 0.
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"
#include "tracer/bsdf/microfacet.h"

namespace vitrail {

struct BaseSample {
  Vector3d in;
  SampledSpectrum weight;  // f·|cos θ_in| / pdf
  double pdf = 0;          // solid angle; 1 where the base is smooth
};

struct LambertBase {
  SampledSpectrum reflectance;
  bool smooth() const { return false; }
};

struct ConductorBase {
  SampledSpectrum eta, k;
  double interface_eta = 1;  // of the coating, that the metal lies in
  Microfacets facets;
  bool smooth() const { return facets.smooth(); }
};

// f without the cosine; 0 where smooth.
SampledSpectrum base_value(const LambertBase& base, Vector3d out, Vector3d in);
double base_pdf(const LambertBase& base, Vector3d out, Vector3d in);
std::optional<BaseSample> sample_base(const LambertBase& base, Vector3d out, Point2f u);

SampledSpectrum base_value(const ConductorBase& base, Vector3d out, Vector3d in);
double base_pdf(const ConductorBase& base, Vector3d out, Vector3d in);
std::optional<BaseSample> sample_base(const ConductorBase& base, Vector3d out, Point2f u);

}  // namespace vitrail
