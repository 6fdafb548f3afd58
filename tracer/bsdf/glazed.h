// SPDX-License-Identifier: Apache-2.0
// POV-Ray's finish of what also mirrors, or lets light through (scene/records/material.h has the equations).
// The lit part is known to `eval`; the mirror and what is behind are deltas. Asked from either side, which
// are alike but for the bending. Beyond the critical angle what lets light through mirrors all of it.
#pragma once

#include <optional>

#include "tracer/bsdf/finish.h"

namespace vitrail {

struct GlazedBsdf {
  FinishBsdf finish;
  SampledSpectrum mirror_min, mirror_max, tint;
  double falloff = 1, metallic = 0;
  bool fresnel = false, conserves_energy = false;
  SampledSpectrum through;
  double eta = 1;  // index behind / in front
};

BsdfValue eval(const GlazedBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const GlazedBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const GlazedBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
