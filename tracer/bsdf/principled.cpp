// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/principled.h"

#include "tracer/bsdf/principled_lanes.h"
#include "tracer/bsdf/principled_lobes.h"

namespace vitrail {

namespace {

lanes::Principled<double> in_one_lane(const PrincipledBsdf& b) {
  return {.base_color = lanes::fill<float>(b.base_color),
          .luminance = b.luminance,
          .eta = b.eta,
          .roughness = b.roughness,
          .metallic = b.metallic,
          .spec_trans = b.spec_trans,
          .spec_tint = b.spec_tint,
          .sheen = b.sheen,
          .sheen_tint = b.sheen_tint,
          .flatness = b.flatness,
          .clearcoat = b.clearcoat,
          .clearcoat_gloss = b.clearcoat_gloss,
          .below = b.below,
          .microfacets = lanes::fill(principled::microfacets(b.roughness, b.anisotropic))};
}

}  // namespace

BsdfValue eval(const PrincipledBsdf& b, Vector3d out, Vector3d in) {
  return lanes::lane(lanes::eval(in_one_lane(b), lanes::fill<double>(out), lanes::fill<double>(in)), 0);
}

double pdf(const PrincipledBsdf& b, Vector3d out, Vector3d in) { return eval(b, out, in).pdf; }

std::optional<BsdfSample> sample(const PrincipledBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  return lanes::lane(lanes::sample(in_one_lane(b), lanes::fill<double>(out), u_lobe, u.x, u.y), 0);
}

}  // namespace vitrail
