// SPDX-License-Identifier: Apache-2.0
// These records are what photon mapping keeps and sends beside rays. They are packed, trivially copyable and
// little-endian.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "scene/spectra/sampled_spectrum.h"
#include "tracer/rays/direction.h"

namespace vitrail {

#pragma pack(push, 1)
// A Photon is where a photon met a surface at which light is gathered. One that crossed the disc of a sensor
// has the sensor's name (sensor_discs.h) in the place of its own point and direction.
struct Photon {
  float p[3];
  DirectionCode direction;  // the way it travelled
  float power[hero_count];  // as a photon's throughput is: times PhotonPass::power_w_nm its power
  std::uint32_t number;     // among those of its iteration
  std::uint16_t depth = 0;  // scatterings before; with the bit of `dispersed` where only its hero is left

  static constexpr std::uint16_t most_depth = 0x7fff, dispersed = 0x8000;
  static std::uint16_t code_of(std::uint32_t depth, bool is_dispersed) {
    return static_cast<std::uint16_t>(std::min<std::uint32_t>(depth, most_depth) |
                                      (is_dispersed ? dispersed : 0u));
  }
};

// A Gather asks for the light that photons bring to a point of a diffuse surface, or of one below a smooth
// coat. It also holds what part of that light goes to the camera. The question of a sensor has the sensor's
// name in `p` and `out`; its normals and shape are unused.
struct Gather {
  float p[3];
  DirectionCode out, geometric, shading;  // towards the camera; normals on the side that is lit
  float weight[hero_count];               // of the path, times the reflectance or transmittance
  float shape;  // 0: Lambertian; > 0: σ of OrenNayarBsdf, radians; < 0: −η of PlasticBsdf's coat
  std::uint32_t pixel;
  std::uint16_t depth;  // scatterings of the path before, and the bit of Photon::dispersed as there
};
#pragma pack(pop)
static_assert(sizeof(Photon) == 40 && std::is_trivially_copyable_v<Photon>);
static_assert(sizeof(Gather) == 56 && std::is_trivially_copyable_v<Gather>);

}  // namespace vitrail
