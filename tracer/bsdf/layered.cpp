// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/layered.h"

#include <algorithm>

#include "tracer/bsdf/layered_lanes.h"

namespace vitrail {

namespace {

lanes::LayerVolume<double> volume_in_one_lane(const LayerVolume& v) {
  const LayerVolume b = bounded(v);
  return {b.thickness,
          b.g,
          lanes::fill<float>(b.albedo),
          static_cast<double>(b.max_depth),
          static_cast<double>(b.samples),
          b.balanced};
}

lanes::Coating<double> coating_in_one_lane(double eta, const Microfacets& facets) {
  return {eta, lanes::fill(facets), facets.smooth() || eta == 1};
}

lanes::CoatedDiffuse<double> layer_in_one_lane(const CoatedDiffuseBsdf& b) {
  return {{lanes::fill<float>(b.reflectance)},
          coating_in_one_lane(b.eta, b.interface),
          volume_in_one_lane(b.volume),
          b.event};
}

lanes::CoatedConductor<double> layer_in_one_lane(const CoatedConductorBsdf& b) {
  return {{lanes::fill<float>(b.eta), lanes::fill<float>(b.k), b.interface_eta, lanes::fill(b.conductor),
           b.conductor.smooth()},
          coating_in_one_lane(b.interface_eta, b.interface),
          volume_in_one_lane(b.volume),
          b.event};
}

template <class Bsdf>
BsdfValue layer_value(const Bsdf& b, Vector3d out, Vector3d in) {
  return lanes::lane(lanes::eval(layer_in_one_lane(b), lanes::fill<double>(out), lanes::fill<double>(in)), 0);
}
template <class Bsdf>
double layer_density(const Bsdf& b, Vector3d out, Vector3d in) {
  return lanes::layer_pdf(layer_in_one_lane(b), lanes::fill<double>(out), lanes::fill<double>(in));
}
template <class Bsdf>
std::optional<BsdfSample> layer_sample(const Bsdf& b, Vector3d out, float u_lobe, Point2f u) {
  return lanes::lane(lanes::sample(layer_in_one_lane(b), lanes::fill<double>(out), u_lobe, u.x, u.y), 0);
}

}  // namespace

LayerVolume bounded(LayerVolume v) {
  v.thickness = std::max(v.thickness, 1e-30);
  v.g = std::clamp(v.g, -0.99, 0.99);
  v.samples = std::max(v.samples, 1);
  return v;
}

BsdfValue eval(const CoatedDiffuseBsdf& b, Vector3d out, Vector3d in) { return layer_value(b, out, in); }
double pdf(const CoatedDiffuseBsdf& b, Vector3d out, Vector3d in) { return layer_density(b, out, in); }
std::optional<BsdfSample> sample(const CoatedDiffuseBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  return layer_sample(b, out, u_lobe, u);
}

BsdfValue eval(const CoatedConductorBsdf& b, Vector3d out, Vector3d in) { return layer_value(b, out, in); }
double pdf(const CoatedConductorBsdf& b, Vector3d out, Vector3d in) { return layer_density(b, out, in); }
std::optional<BsdfSample> sample(const CoatedConductorBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  return layer_sample(b, out, u_lobe, u);
}

}  // namespace vitrail
