// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/plastic.h"

#include "tracer/bsdf/plastic_lanes.h"

namespace vitrail {

namespace {

template <class Bsdf>
lanes::Plastic<double> coated(const Bsdf& bsdf, double internal_reflectance) {
  return {lanes::fill<float>(bsdf.diffuse_reflectance), lanes::fill<float>(bsdf.specular_reflectance),
          bsdf.eta, internal_reflectance, bsdf.nonlinear};
}
lanes::Plastic<double> in_one_lane(const PlasticBsdf& bsdf) {
  return coated(bsdf, bsdf.internal_reflectance);
}
auto in_one_lane(const RoughPlasticBsdf& bsdf) {
  const auto table = [tables = bsdf.tables](int) { return tables->external_transmittance.data(); };
  return lanes::RoughPlastic<double, decltype(table)>{coated(bsdf, bsdf.tables->internal_reflectance),
                                                      lanes::fill(bsdf.microfacets), table};
}

template <class Bsdf>
BsdfValue value(const Bsdf& bsdf, Vector3d out, Vector3d in) {
  return lanes::lane(lanes::eval(in_one_lane(bsdf), lanes::fill<double>(out), lanes::fill<double>(in)), 0);
}
template <class Bsdf>
std::optional<BsdfSample> sampled(const Bsdf& bsdf, Vector3d out, float u_lobe, Point2f u) {
  return lanes::lane(lanes::sample(in_one_lane(bsdf), lanes::fill<double>(out), u_lobe, u.x, u.y), 0);
}

}  // namespace

BsdfValue eval(const PlasticBsdf& bsdf, Vector3d out, Vector3d in) { return value(bsdf, out, in); }
double pdf(const PlasticBsdf& bsdf, Vector3d out, Vector3d in) { return eval(bsdf, out, in).pdf; }
std::optional<BsdfSample> sample(const PlasticBsdf& bsdf, Vector3d out, float u_lobe, Point2f u) {
  return sampled(bsdf, out, u_lobe, u);
}

SampledSpectrum base_of(const PlasticBsdf& bsdf, double cosine_out) {
  const lanes::Plastic<double> plastic = in_one_lane(bsdf);
  return lanes::lane(lanes::detail::base(plastic), 0) *
         static_cast<float>(lanes::detail::transmittance(plastic, cosine_out));
}

BsdfValue eval(const RoughPlasticBsdf& bsdf, Vector3d out, Vector3d in) { return value(bsdf, out, in); }
double pdf(const RoughPlasticBsdf& bsdf, Vector3d out, Vector3d in) { return eval(bsdf, out, in).pdf; }
std::optional<BsdfSample> sample(const RoughPlasticBsdf& bsdf, Vector3d out, float u_lobe, Point2f u) {
  return sampled(bsdf, out, u_lobe, u);
}

}  // namespace vitrail
