// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tests/support/temporary_directory.h"
#include "tests/tracer/lanes/context.h"

namespace vitrail::lane_tests {

// What a Context shows.
struct Fixtures {
  Fixtures();
  Fixtures(const Fixtures&) = delete;
  std::vector<float> tables[2];
  std::vector<Spectrum> spectra;
  std::vector<FlatSpectrum> flat_spectra;
  DomainContent contents[fixture_domains];
  DomainView views[fixture_domains];
  std::vector<EmissiveTriangle> triangles;
  std::vector<AreaLight> area_lights;
  LightSampler lights;
  std::vector<LightSampler::Face> faces;
  std::vector<EmissiveQuadric> spheres;
  std::vector<PlacedQuadric> placed_spheres;
  LightTree trees[fixture_trees];
  std::vector<PointLight> point_lights;  // that the emitters refer to, with those that follow
  std::vector<SpotLight> spot_lights;
  std::vector<Fading> fadings;
  test::TemporaryDirectory directory;
  std::vector<Environment> environments;
  SampledWavelengths some_wavelengths;
  bool two_sided[fixture_lamps] = {};
  Context context{};
};
const Fixtures& fixtures();

}  // namespace vitrail::lane_tests
