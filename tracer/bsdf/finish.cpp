// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/finish.h"

#include "tracer/bsdf/finish_lanes.h"

namespace vitrail {

namespace {

lanes::Finish<double> in_one_lane(const FinishBsdf& b) {
  return {lanes::fill<float>(b.reflectance),
          lanes::fill<float>(b.highlight),
          b.brilliance,
          b.phong,
          b.phong_size,
          b.specular,
          b.roughness};
}

}  // namespace

BsdfValue eval(const FinishBsdf& b, Vector3d out, Vector3d in) {
  return lanes::lane(lanes::eval(in_one_lane(b), lanes::fill<double>(out), lanes::fill<double>(in)), 0);
}
double pdf(const FinishBsdf& b, Vector3d out, Vector3d in) { return eval(b, out, in).pdf; }
std::optional<BsdfSample> sample(const FinishBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  return lanes::lane(lanes::sample(in_one_lane(b), lanes::fill<double>(out), u_lobe, u.x, u.y), 0);
}

}  // namespace vitrail
