// SPDX-License-Identifier: Apache-2.0
// This file has a base under a dielectric coating, as in pbrt-v4 (after Guo, Hašan and Zhao 2018). Light
// refracts into a slab of `thickness` mean free paths, walks at random between its interface and the base,
// and leaves. Values are estimates of the mean over such walks. The walks' random numbers are a hash of
// `event` and of both directions: values are functions of these, bit for bit. A sample is of one walk, too:
// its weight agrees with eval and pdf in the mean only. pdf is near the density of sample, not exactly it: it
// serves to weigh strategies against each other. Both models only reflect. In the mean they are reciprocal
// and conserve energy.
//
// As in pbrt, eval does not find paths that collide in the layer and then meet a smooth metal under a smooth
// interface; sample does. pbrt weighs the ways out through a rough interface by densities of different
// directions, so that its values are 2 to 10 % brighter than its samples; here they are weighed by densities
// of the same one (Veach 1997, §9.2), unless `balanced` is false.
#pragma once

#include <cstdint>
#include <optional>

#include "tracer/bsdf/bsdf.h"
#include "tracer/bsdf/microfacet.h"

namespace vitrail {

// It is the layer between interface and base, of extinction 1: it only absorbs where the albedo is 0.
struct LayerVolume {
  double thickness = 0.01;
  double g = 0;  // of Henyey and Greenstein, in (−1, 1)
  SampledSpectrum albedo;
  int max_depth = 10;    // of crossings and collisions in a walk
  int samples = 1;       // walks an eval
  bool balanced = true;  // false: ways out are weighed as pbrt-v4 weighs them
};
// Returns the same with numbers that a walk can use: thickness > 0, |g| < 1, samples ≥ 1.
LayerVolume bounded(LayerVolume volume);

struct CoatedDiffuseBsdf {
  SampledSpectrum reflectance;
  double eta = 1.5;  // of the coating / of what is in front
  Microfacets interface;
  LayerVolume volume;
  std::uint64_t event = 0;  // differs wherever other walks are wanted
};

struct CoatedConductorBsdf {
  SampledSpectrum eta, k;  // of the metal against vacuum
  Microfacets conductor;
  double interface_eta = 1.5;
  Microfacets interface;
  LayerVolume volume;
  std::uint64_t event = 0;
};

BsdfValue eval(const CoatedDiffuseBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const CoatedDiffuseBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const CoatedDiffuseBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

BsdfValue eval(const CoatedConductorBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const CoatedConductorBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const CoatedConductorBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
