// SPDX-License-Identifier: Apache-2.0
// A FourierBsdf scatters by a table of Fourier coefficients (scene/records/scattering_table.h), seen from
// either side. Directions are sampled by the luminance Y of f·|cos θ_in|. First comes the cosine, by the
// integrals of a₀ along it, then the azimuth, by its integral. Both are inverted numerically, so the pdf is
// Y/∫Y d in, where Y > 0.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/records/scattering_table.h"
#include "tracer/bsdf/bsdf.h"

namespace vitrail {

// These integrals belong to a table, and are made when it is loaded. [μₒ][μᵢ] is ∫ a₀ dμᵢ from the first node
// to that one, for light towards that μₒ.
struct FourierIntegrals {
  std::vector<double> up_to;
};
FourierIntegrals integrals_of(const FourierTable& table);

struct FourierBsdf {
  const FourierTable* table = nullptr;  // these two outlive it
  const FourierIntegrals* integrals = nullptr;
  std::array<SampledSpectrum, 3> primaries;  // what red, green and blue reflect: scene/spectra/srgb_basis.h
};

BsdfValue eval(const FourierBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const FourierBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const FourierBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
