// SPDX-License-Identifier: Apache-2.0
// The dielectric interface above a layer, met from either side, of one colour (Walter et al. 2007). `out` and
// `in` lie on either side: z > 0 is above.
#pragma once

#include <optional>

#include "tracer/bsdf/microfacet.h"

namespace vitrail {

struct Coating {
  double eta = 1.5;  // below / above
  Microfacets facets;
  bool smooth() const { return facets.smooth() || eta == 1; }
};

struct CoatingSample {
  Vector3d in;
  double weight = 0;  // f·|cos θ_in| / pdf
  double pdf = 0;     // solid angle; 1 where smooth
};

// Half vector of two directions on one side, or on both, h.z ≥ 0; the reflectance of a facet that `out`
// meets, and whether both directions see it as they should.
struct CoatingHalf {
  Vector3d h;
  double eta = 1;  // on the other side of `out` / on its side
  double fresnel = 0;
  bool valid = false;
};
CoatingHalf coating_half(const Coating& coating, Vector3d out, Vector3d in);

// f without the cosine; 0 where smooth. Of radiance: 1/η² is in transmitted values.
double coating_reflection(const Coating& coating, Vector3d out, Vector3d in);
double coating_transmission(const Coating& coating, Vector3d out, Vector3d in);

// Of a sample that is known to be reflected or to be transmitted.
double coating_reflected_pdf(const Coating& coating, Vector3d out, Vector3d in);
double coating_transmitted_pdf(const Coating& coating, Vector3d out, Vector3d in);

// Its weights are those of radiance from `in`; for light that goes from `out` instead, they are η² (of the
// index across / on the side of `out`) times as large.
std::optional<CoatingSample> sample_coating_reflection(const Coating& coating, Vector3d out, Point2f u);
std::optional<CoatingSample> sample_coating_transmission(const Coating& coating, Vector3d out, Point2f u);
// Either, by the reflectance of the facet, which the weight is without; the pdf is that of the one chosen.
std::optional<CoatingSample> sample_coating(const Coating& coating, Vector3d out, double u_lobe, Point2f u);

}  // namespace vitrail
