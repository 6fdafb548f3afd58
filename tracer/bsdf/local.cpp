// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/local.h"

#include "tracer/bsdf/local_lanes.h"

namespace vitrail {

Vector3d sample_cosine_hemisphere(float u, float v) {
  return lanes::lane(lanes::sample_cosine_hemisphere(u, v), 0);
}

double attainable(double p) { return lanes::attainable(p); }

double fresnel_dielectric(double cosine, double eta) { return lanes::fresnel_dielectric(cosine, eta); }

bool refract(Vector3d out, Vector3d normal, double eta, Vector3d& refracted) {
  lanes::Vector<double> there;
  const bool passes = lanes::refract(lanes::fill<double>(out), lanes::fill<double>(normal), eta, there);
  if (passes) refracted = lanes::lane(there, 0);
  return passes;
}

}  // namespace vitrail
