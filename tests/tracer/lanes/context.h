// SPDX-License-Identifier: Apache-2.0
// What the functions read that are given more than numbers.
#pragma once

#include "tracer/lanes/interaction.h"
#include "tracer/lights/light_sampler.h"
#include "tracer/sampling/flat_spectrum.h"
#include "tracer/sampling/wavelengths.h"
#include "tracer/textures/baked_image.h"

namespace vitrail::lane_tests {

inline constexpr std::uint32_t fixture_clusters = 64, fixture_lamps = 64, fixture_domains = 4,
                               fixture_trees = 5, fixture_emitters = 8, fixture_spheres = 32,
                               fixture_images = 5, fixture_environments = fixture_images + 2,
                               fixture_spectra = 5;

inline constexpr float fixture_factor = 0.7f;  // of all spectra

struct Context {
  WavelengthTables wavelengths;
  const float *observer, *d65;
  const float* tables[2];                       // spectra
  const FlatSpectrum* flat_spectra;             // fixture_spectra, one of each kind that has numbers
  lanes::DomainTables domain[fixture_domains];  // with normals if 1, with (u, v) if 2 is set in the index
  const LightSampler::Slot* slots;              // of triangles that emit
  const LightSampler::Face* faces;              // of each slot
  const bool* two_sided;
  const PlacedQuadric* spheres;              // fixture_spheres
  const BakedImage* images[fixture_images];  // of kinds of spectra and of numbers
  const Environment* environments;           // those images, a sky with a sun, a sun alone
  const SampledWavelengths* some_wavelengths;
  const LightTree* trees[fixture_trees];  // of few lights, of many, by power, of none, of one lamp
  const PointEmitter* emitters;           // fixture_emitters
};

}  // namespace vitrail::lane_tests
