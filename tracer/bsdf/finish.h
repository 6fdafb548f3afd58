// SPDX-License-Identifier: Apache-2.0
// A FinishBsdf is POV-Ray's finish (scene/records/material.h has the equation): its highlights are not
// normalised and not reciprocal. Half of the directions are sampled from a hemisphere of even density, since
// highlights have no cosine.
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"

namespace vitrail {

struct FinishBsdf {
  SampledSpectrum reflectance, highlight;
  double brilliance = 1, phong = 0, phong_size = 40, specular = 0, roughness = 0.05;
};

BsdfValue eval(const FinishBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const FinishBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const FinishBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
