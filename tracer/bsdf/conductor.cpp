// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/conductor.h"

#include "tracer/bsdf/conductor_lanes.h"

namespace vitrail {

namespace {

lanes::Conductor<double> in_one_lane(const ConductorBsdf& bsdf) {
  return {lanes::fill(bsdf.microfacets), lanes::fill<float>(bsdf.eta), lanes::fill<float>(bsdf.k),
          lanes::fill<float>(bsdf.factor), bsdf.perfect};
}

}  // namespace

BsdfValue eval(const ConductorBsdf& bsdf, Vector3d out, Vector3d in) {
  if (bsdf.microfacets.smooth()) return {};
  return lanes::lane(lanes::eval(in_one_lane(bsdf), lanes::fill<double>(out), lanes::fill<double>(in)), 0);
}

double pdf(const ConductorBsdf& bsdf, Vector3d out, Vector3d in) { return eval(bsdf, out, in).pdf; }

std::optional<BsdfSample> sample(const ConductorBsdf& bsdf, Vector3d out, float, Point2f u) {
  const lanes::Conductor<double> conductor = in_one_lane(bsdf);
  const auto from = lanes::fill<double>(out);
  if (bsdf.microfacets.smooth()) return lanes::lane(lanes::sample_mirror(conductor, from), 0);
  return lanes::lane(lanes::sample(conductor, from, u.x, u.y), 0);
}

}  // namespace vitrail
