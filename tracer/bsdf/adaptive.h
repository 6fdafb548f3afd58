// SPDX-License-Identifier: Apache-2.0
// This model reflects by a table of measurements (Dupuy and Jakob 2018; scene/records/scattering_table.h). A
// place of the unit square is warped twice, by the luminance and by the visible normals, to a microfacet's
// normal m, which mirrors `out`. The place before the second warp looks up the table's spectra.
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"
#include "tracer/bsdf/warp.h"

namespace vitrail {

// These warps belong to a table, and are made when it is loaded.
struct AdaptiveWarps {
  Warp luminance, visible_normals;
};
AdaptiveWarps warps_of(const AdaptiveTable& table);

struct AdaptiveBsdf {
  const AdaptiveTable* table = nullptr;  // these two outlive it
  const AdaptiveWarps* warps = nullptr;
  SampledWavelengths wavelengths;
};

BsdfValue eval(const AdaptiveBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const AdaptiveBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const AdaptiveBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
