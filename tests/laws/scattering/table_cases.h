// SPDX-License-Identifier: Apache-2.0
// Tables of scattering whose model is known, and files of them.
#pragma once

#include <filesystem>
#include <functional>

#include "scene/records/scattering_table.h"
#include "tracer/bsdf/microfacet.h"

namespace vitrail::laws {

// f·|cos θ_in| of a model without a preferred azimuth: directions as eval has them.
using Lobe = std::function<double(Vector3d out, Vector3d in)>;

// Its expansion, all channels in the same proportion to it: R, G and B of `color`, or one channel. Nodes are
// cosines of evenly spaced angles, and 0 twice.
FourierTable fourier_table(const Lobe& lobe, int nodes_a_side, std::uint32_t orders, float eta = 1,
                           const std::array<double, 3>* color = nullptr);
void write(const FourierTable& table, const std::filesystem::path& file);

// Measurements of perfectly reflecting facets, times how much of a wavelength the surface reflects (linear
// from `low` at 400 nm to `high` at 700 nm). Anisotropic where the widths differ: a quarter of the azimuths.
struct FacetTable {
  Microfacets facets;
  double low = 1, high = 1;
  std::uint32_t resolution = 32;
  int incidences = 8;
};
AdaptiveTable adaptive_table(const FacetTable& of);
void write(const AdaptiveTable& table, const std::filesystem::path& file);

}  // namespace vitrail::laws
