// SPDX-License-Identifier: Apache-2.0
// Choosing a point on a light to connect to. Constant infinite lights are left to the BSDF's own samples,
// which find them with weight 1: for a diffuse surface nothing is better.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bundle/manifest.h"
#include "tracer/wavelengths.h"

namespace vitrail {

// All emissive triangles together are one choice, every point and every distant light one each; all equally
// likely. Within the triangles one is taken with probability ∝ area · luminance.
struct LightSampler {
  std::vector<std::uint32_t> delta;      // indices into Manifest::lights
  std::vector<std::uint32_t> triangles;  // indices into Manifest::emissive_triangles, those with power
  std::vector<double> cumulative;        // of them, 0 … 1, one more than triangles
  std::vector<float> area_pdf;  // per area light: density of its points, per unit area, the choice included
  std::vector<std::uint32_t> infinite;  // indices into Manifest::lights

  std::size_t choices() const { return delta.size() + (triangles.empty() ? 0 : 1); }
};

LightSampler make_light_sampler(const Manifest& manifest);

struct LightSample {
  Vector3d to_light;    // unit
  double distance = 0;  // ∞ for distant lights
  SampledSpectrum
      radiance;    // for points on triangles: radiance; for delta lights: irradiance across the direction
  double pdf = 0;  // triangles: solid angle, the choice included; delta lights: probability of the choice
  bool is_delta = false;
};

// A connection from p; u picks the light and the point. Empty where nothing arrives.
std::optional<LightSample> sample_light(const LightSampler& sampler, const Manifest& manifest, Point3d p,
                                        const std::array<float, 4>& u, const SampledWavelengths& wavelengths);

// Sum of the constant infinite lights.
SampledSpectrum sky_radiance(const LightSampler& sampler, const Manifest& manifest,
                             const SampledWavelengths& wavelengths);

// Whether light of some distant source travels against `direction`, to the precision of ray directions.
bool points_at_distant_light(const LightSampler& sampler, const Manifest& manifest, Vector3d direction);

}  // namespace vitrail
