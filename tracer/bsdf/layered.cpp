// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/layered.h"

#include <algorithm>

#include "tracer/bsdf/layered_walk.h"

namespace vitrail {

namespace {

LayerVolume bounded(LayerVolume v) {
  v.thickness = std::max(v.thickness, 1e-30);
  v.g = std::clamp(v.g, -0.99, 0.99);
  return v;
}

Layer<LambertBase> layer_of(const CoatedDiffuseBsdf& b) {
  return {{b.reflectance}, {b.eta, b.interface}, bounded(b.volume), b.event};
}

Layer<ConductorBase> layer_of(const CoatedConductorBsdf& b) {
  return {
      {b.eta, b.k, b.interface_eta, b.conductor}, {b.interface_eta, b.interface}, bounded(b.volume), b.event};
}

// Density, about, of what leaves after it was reflected by the base, of that which does.
double base_lobe(const Layer<LambertBase>&, Vector3d, Vector3d in, WalkRandom&) { return in.z / pi; }

// A rough metal seen through the interface: one estimate of the density over the directions that rough
// interfaces refract to, by either side of the base's reflection; and whether what the base reflects gets
// out.
struct MetalLobe {
  double density = 0;
  bool leaves = false;
};

MetalLobe metal_lobe(const Layer<ConductorBase>& layer, Vector3d out, Vector3d in, WalkRandom& random) {
  const Coating& coating = layer.coating;
  const auto wos = sample_coating_transmission(coating, out, random.uniform_pair());
  const auto wis = sample_coating_transmission(coating, in, random.uniform_pair());
  if (!wos || !wis) return {};
  const Vector3d seen = -wos->in, to_in = -wis->in;
  const double by_base = base_pdf(layer.base, seen, to_in);
  const auto reflected = sample_base(layer.base, seen, random.uniform_pair());
  MetalLobe lobe;
  if (reflected)
    lobe.leaves = sample_coating_transmission(coating, -reflected->in, random.uniform_pair()).has_value();
  if (coating.smooth()) {
    lobe.density = by_base * in.z / (coating.eta * coating.eta * to_in.z);
    return lobe;
  }
  if (reflected) {
    const double through = coating_transmitted_pdf(coating, -reflected->in, in);
    const double other = coating_transmitted_pdf(coating, in, -reflected->in);
    lobe.density = layer.base.smooth() ? through : through * power_heuristic(reflected->pdf, other);
  }
  if (by_base > 0)
    lobe.density += by_base * coating_transmitted_pdf(coating, -to_in, in) / wis->pdf *
                    power_heuristic(wis->pdf, by_base);
  return lobe;
}

double base_lobe(const Layer<ConductorBase>& layer, Vector3d out, Vector3d in, WalkRandom& random) {
  if (layer.coating.smooth() && layer.base.smooth()) return in.z / pi;  // after collisions only
  constexpr double narrow = 0.9;  // the rest goes back and forth before it leaves
  const MetalLobe lobe = metal_lobe(layer, out, in, random);
  return narrow * lobe.density + (1 - (lobe.leaves ? narrow : 0)) * in.z / pi;
}

template <class Base>
double layer_pdf(const Layer<Base>& layer, Vector3d out, Vector3d in) {
  if (!(out.z > 0) || !(in.z > 0) || layer.only_specular()) return 0;
  const Coating& coating = layer.coating;
  WalkRandom random(layer.event, 2);
  random << out << in;
  Vector3d facet{0, 0, 1};
  double reflected = 0;
  if (!coating.smooth()) {
    facet = sample_visible_normal(coating.facets, out, random.uniform_pair());
    const CoatingHalf half = coating_half(coating, out, in);
    reflected = half.fresnel * coating_reflected_pdf(coating, out, in);
  }
  const double entering = 1 - fresnel_dielectric(std::clamp(dot(out, facet), 0.0, 1.0), coating.eta);
  return reflected + entering * base_lobe(layer, out, in, random);
}

template <class Base>
BsdfValue layer_eval(const Layer<Base>& layer, Vector3d out, Vector3d in) {
  if (!(out.z > 0) || !(in.z > 0) || layer.only_specular()) return {};
  WalkRandom random(layer.event, 1);
  random << out << in;
  SampledSpectrum sum{};
  const int walks = std::max(1, layer.volume.samples);
  for (int i = 0; i < walks; ++i) sum = sum + walk_value(layer, out, in, random);
  const auto reflected = static_cast<float>(coating_reflection(layer.coating, out, in) * in.z);
  return {filled(reflected) + sum * (1 / static_cast<float>(walks)), layer_pdf(layer, out, in)};
}

template <class Base>
std::optional<BsdfSample> layer_sample(const Layer<Base>& layer, Vector3d out, float u_lobe, Point2f u) {
  if (!(out.z > 0)) return std::nullopt;
  const auto walk = sample_walk(layer, out, u_lobe, u);
  if (!walk || !(walk->in.z > 0)) return std::nullopt;
  BsdfSample s{.in = walk->in, .weight = walk->weight, .specular = walk->specular};
  if (s.specular) return s;
  s.pdf = layer_pdf(layer, out, s.in);
  if (!(s.pdf > 0)) return std::nullopt;
  return s;
}

}  // namespace

BsdfValue eval(const CoatedDiffuseBsdf& b, Vector3d out, Vector3d in) {
  return layer_eval(layer_of(b), out, in);
}
double pdf(const CoatedDiffuseBsdf& b, Vector3d out, Vector3d in) { return layer_pdf(layer_of(b), out, in); }
std::optional<BsdfSample> sample(const CoatedDiffuseBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  return layer_sample(layer_of(b), out, u_lobe, u);
}

BsdfValue eval(const CoatedConductorBsdf& b, Vector3d out, Vector3d in) {
  return layer_eval(layer_of(b), out, in);
}
double pdf(const CoatedConductorBsdf& b, Vector3d out, Vector3d in) {
  return layer_pdf(layer_of(b), out, in);
}
std::optional<BsdfSample> sample(const CoatedConductorBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  return layer_sample(layer_of(b), out, u_lobe, u);
}

}  // namespace vitrail
