// SPDX-License-Identifier: Apache-2.0
// This file defines the interface of scattering at a point. Directions are unit and point away from the
// surface, in the local frame whose +z is the shading normal and whose +x follows dp/du. A model that only
// reflects is called with `out` above (out.z > 0). On the back of a two-sided surface the caller turns the
// frame over. A model that transmits is called from either side: z > 0 is the front of the surface.
//
// Each model is a plain record of its parameters at one point and at the wavelengths of one path, with three
// functions:
//
//   BsdfValue eval(const Model&, Vector3d out, Vector3d in);
//   double pdf(const Model&, Vector3d out, Vector3d in);
//   std::optional<BsdfSample> sample(const Model&, Vector3d out, float u_lobe, Point2f u);
#pragma once

#include "scene/geometry/vec.h"
#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

struct BsdfValue {
  SampledSpectrum value;  // f(out, in)·|cos θ_in|, without specular (delta) parts; radiance, so ∝ 1/η² across
                          // an interface
  double pdf = 0;  // of `sample` giving `in`, solid angle, the choice of the lobe included
};

struct BsdfSample {
  Vector3d in;             // where the path goes on; unit
  SampledSpectrum weight;  // f·|cos θ_in| / pdf
  double pdf = 0;          // solid angle; 0 where `specular`
  bool specular = false;   // a delta: eval and pdf know nothing of it
};

// Returns Σ throughput·s: `s` weighted by what a path carries at each wavelength. A choice with a probability
// in proportion to it lets the sum of the throughput never grow, however many choices there are.
inline double carried(const SampledSpectrum& throughput, const SampledSpectrum& s) {
  double sum = 0;
  for (std::size_t i = 0; i < hero_count; ++i)
    sum += static_cast<double>(throughput.v[i]) * static_cast<double>(s.v[i]);
  return sum;
}

}  // namespace vitrail
