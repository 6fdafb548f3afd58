// SPDX-License-Identifier: Apache-2.0
// A GlazedBsdf is POV-Ray's finish of a material that also mirrors, or lets light through
// (scene/records/material.h has the equations). `eval` knows the lit part; the mirror and the transmitted
// light are deltas. It is seen from either side, and the sides are alike but for the bending. Beyond the
// critical angle a material that lets light through mirrors all of it.
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
