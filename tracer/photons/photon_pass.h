// SPDX-License-Identifier: Apache-2.0
// A PhotonPass is what one iteration of photon mapping is to the tracer: first photons fly, then paths gather
// them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tracer/lights/emission.h"
#include "tracer/photons/photon_map.h"
#include "tracer/photons/sensor_discs.h"
#include "tracer/sampling/sampler.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

struct PhotonPass {
  std::uint32_t iteration = 0;  // the sample of all pixels
  std::uint64_t photons = 0;    // in it
  double radius = 0;
  // Photons are divided into parts, in turn, with the paths that gather them. A picture has one part, sensors
  // have one for each row of the film. So rows know nothing of each other, and their scatter is the error of
  // their mean.
  struct Part {
    float wavelength_number = 0, time_number = 0;  // of all of its photons and paths
    SampledWavelengths wavelengths;
  };
  std::vector<Part> parts{1};
  double power_w_nm = 0;  // of a photon whose throughput is 1
  bool flying = false;    // records are of photons; else of paths, which gather

  const Emission* emission = nullptr;
  const PhotonMap* map = nullptr;
  const SensorDiscs* sensors = nullptr;  // photons are for them; null: for a picture
  // It is 1 for domains in whose cell a point may lie: the map knows of all photons around it. Empty: for all
  // domains.
  const std::vector<std::uint8_t>* answers = nullptr;

  std::uint32_t part_of_photon(std::uint32_t number) const {
    return static_cast<std::uint32_t>(number * parts.size() / photons);
  }
  std::uint32_t part_of_row(int row) const { return sensors ? static_cast<std::uint32_t>(row) : 0; }
};

// Returns the key of a photon: the sequence is stratified over the photons of an iteration.
inline SampleKey photon_key(std::uint64_t seed, std::uint32_t iteration, std::uint32_t number) {
  constexpr std::uint64_t apart_from_paths = 0x9c5d1ab7f20e4c61u;
  return {mix(seed ^ apart_from_paths), iteration, number};
}
// Returns the number that gives a part of an iteration its wavelengths, for sample_wavelengths: all paths of
// the part share the four.
inline float wavelength_number(std::uint64_t seed, std::uint32_t iteration, std::uint32_t part) {
  constexpr std::uint64_t apart = 0x51a7e5d0c3b92f87u;
  const std::array<float, 4> u = sample_4d({mix(seed ^ apart), part, iteration}, sample_set::camera);
  return number_of_hero(u[0], std::floor(4 * u[1]));
}
// Returns when a part sees the scene, in parts of the time that the shutter is open.
inline float time_number(std::uint64_t seed, std::uint32_t iteration, std::uint32_t part) {
  constexpr std::uint64_t apart = 0x2f8b6c41d9e07a35u;
  return sample_4d({mix(seed ^ apart), part, iteration}, sample_set::camera)[0];
}

}  // namespace vitrail
