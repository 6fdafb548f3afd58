// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/microfacet.h"

#include "tracer/bsdf/microfacet_lanes.h"

namespace vitrail {

Microfacets make_microfacets(double alpha_u, double alpha_v, Roughness::Distribution distribution,
                             Masking masking) {
  const bool smooth = !(alpha_u > 0) && !(alpha_v > 0);
  const auto width = [&](double alpha) {
    return smooth ? 0 : alpha > least_alpha ? std::min(alpha, 1e4) : least_alpha;
  };
  return {width(alpha_u), width(alpha_v), distribution, masking};
}

double normal_density(const Microfacets& mf, Vector3d m) {
  return lanes::normal_density(lanes::fill(mf), lanes::fill<double>(m));
}

double visible_area(const Microfacets& mf, Vector3d v) {
  return lanes::visible_area(lanes::fill(mf), lanes::fill<double>(v));
}

double masking(const Microfacets& mf, Vector3d v, Vector3d m) {
  if (!(dot(v, m) * v.z > 0)) return 0;
  const Vector3d above = v.z < 0 ? -v : v;
  return above.z / visible_area(mf, above);
}

double shadowing_over_cosines(const Microfacets& mf, Vector3d a, double area_a, Vector3d b) {
  return lanes::shadowing_over_cosines(lanes::fill(mf), lanes::fill<double>(a), area_a,
                                       lanes::fill<double>(b));
}

Vector3d sample_visible_normal(const Microfacets& mf, Vector3d v, Point2f u) {
  return lanes::lane(lanes::sample_visible_normal(lanes::fill(mf), lanes::fill<double>(v), u.x, u.y), 0);
}

double visible_normal_pdf(const Microfacets& mf, Vector3d v, Vector3d m) {
  return std::max(0.0, dot(v, m)) * normal_density(mf, m) / visible_area(mf, v);
}

}  // namespace vitrail
