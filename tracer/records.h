// SPDX-License-Identifier: Apache-2.0
// The state of a ray between domains: what waits in queues and travels between ranks. Packed, trivially
// copyable, little-endian. Wavelengths and random numbers are functions of (seed, pixel, sample), so they do
// not travel.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "scene/sampled_spectrum.h"
#include "tracer/direction.h"

namespace vitrail {

static_assert(std::endian::native == std::endian::little);

// Samples a pixel are numbered in 24 bits, depth in 8, domains in 16.
inline constexpr std::uint32_t max_samples = 1u << 24;
inline constexpr int max_path_depth = 254;
inline constexpr std::uint32_t max_domains = 0xffff;

enum PathFlags : std::uint8_t {
  path_dispersed = 1,   // only the hero wavelength is left
  path_connection = 2,  // on its way to a light through what lets light straight through; `throughput` is the
                        // radiance that it will deposit
  path_resolved = 4,    // the hit is certain: to be shaded in hit_domain
  path_in_pane = 8,     // inside a dispersive medium, all wavelengths alive: the face it entered by is known;
                        // of a connection: smooth interfaces refract it
};

#pragma pack(push, 1)
// A path on its way to its next hit, with the best hit so far. Or a connection: it ends at hit_t, where its
// light is, without a hit.
struct PathRecord {
  double hit_t;  // ∞: none yet
  std::uint32_t hit_triangle;
  std::uint16_t hit_domain;  // which domain found it
  DirectionCode direction;
  float origin[3];
  std::uint8_t throughput[hero_count][3];  // as radiance_code
  std::uint32_t exclude;                   // triangle it starts on
  std::uint32_t pixel;
  std::uint32_t sample_depth;  // sample << 8 | depth
  std::uint16_t pdf;           // of the last scattering, solid angle, as pdf_code; 0: specular or camera.
                               // In a pane: low 16 bits of the FaceCode; of a connection, of its aim, or
                               // where that is straight of its end_code
  std::uint8_t flags;          // PathFlags, and above them 4 bits: high bits of the FaceCode or the aim
  // Since the last scattering, straight through surfaces, as radiance_code. Where images are filtered, a path
  // has the cone_code of its ray's width in the lowest byte. Of a straight connection: what is left to its
  // light, the high bits of the end_code.
  std::uint8_t travelled[3];
  std::uint8_t inside;  // state of Interiors
};

// A ray to a point on a light. It deposits `radiance` unless something is hit in (0, tmax).
struct ShadowRecord {
  float origin[3];
  DirectionCode direction;
  float tmax;
  std::uint32_t exclude;
  std::uint8_t radiance[hero_count][3];  // as radiance_code
  std::uint32_t pixel;
  std::uint32_t sample;
};
#pragma pack(pop)
static_assert(sizeof(PathRecord) == 63 && std::is_trivially_copyable_v<PathRecord>);
static_assert(sizeof(ShadowRecord) == 46 && std::is_trivially_copyable_v<ShadowRecord>);

// A pdf ≥ 0 rounded to bfloat16. Both strategies of multiple importance sampling use the rounded value, so
// their weights still add up to 1.
inline std::uint16_t pdf_code(float pdf) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(pdf);
  return static_cast<std::uint16_t>((bits + 0x7fff + ((bits >> 16) & 1)) >> 16);
}
inline float pdf_value(std::uint16_t code) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(code) << 16);
}

// A width relative to the scene's scale: 3 bits of mantissa, from 2⁻²⁶ to 2⁶; 0: none.
inline std::uint8_t cone_code(double relative_width) {
  constexpr int least = (127 - 26) << 3;
  const auto bits = static_cast<int>(std::bit_cast<std::uint32_t>(static_cast<float>(relative_width)) >> 20);
  return static_cast<std::uint8_t>(std::clamp(bits - least, 0, 255));
}
inline double cone_value(std::uint8_t code) {
  constexpr std::uint32_t least = (127 - 26) << 3;
  return code == 0 ? 0 : static_cast<double>(std::bit_cast<float>((code + least) << 20));
}

// A radiance ≥ 0 rounded to 8 bits of exponent and 16 of mantissa: relative error ≤ 2⁻¹⁷, unbiased over many.
inline void pack_radiance(float value, std::uint8_t out[3]) {
  const std::uint32_t bits = (std::bit_cast<std::uint32_t>(value) << 1) + 0x80;
  out[0] = static_cast<std::uint8_t>(bits >> 8);
  out[1] = static_cast<std::uint8_t>(bits >> 16);
  out[2] = static_cast<std::uint8_t>(bits >> 24);
}
inline float unpack_radiance(const std::uint8_t in[3]) {
  const std::uint32_t bits = static_cast<std::uint32_t>(in[0]) << 8 |
                             static_cast<std::uint32_t>(in[1]) << 16 |
                             static_cast<std::uint32_t>(in[2]) << 24;
  return std::bit_cast<float>(bits >> 1);
}
inline float rounded_radiance(float value) {
  std::uint8_t packed[3];
  pack_radiance(value, packed);
  return unpack_radiance(packed);
}

// A distance rounded as it travels: with 16 bits of mantissa, or 8 beside a cone.
inline float rounded_distance(float value, bool beside_cone) {
  std::uint8_t packed[3];
  pack_radiance(value, packed);
  if (beside_cone) packed[0] = 0;
  return unpack_radiance(packed);
}

}  // namespace vitrail
