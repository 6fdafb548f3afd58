// SPDX-License-Identifier: Apache-2.0
// The state of a ray between domains: what waits in queues and travels between ranks. Packed, trivially
// copyable, little-endian. Wavelengths and random numbers are functions of (seed, pixel, sample), so they do
// not travel.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "scene/spectra/sampled_spectrum.h"
#include "tracer/rays/direction.h"

namespace vitrail {

static_assert(std::endian::native == std::endian::little);

// Samples a pixel are numbered in 23 bits, depth in 17, domains in 16.
inline constexpr std::uint32_t max_samples = 1u << 23;
inline constexpr int max_path_depth = (1 << 17) - 1;
inline constexpr int max_direct_depth =
    max_path_depth >> 2;  // the highest bit says that the path has scattered
inline constexpr std::uint32_t max_domains = 0xffff;

enum PathFlags : std::uint8_t {
  path_dispersed = 1,   // only the hero wavelength is left
  path_connection = 2,  // on its way to a light through what lets light straight through; `throughput` is the
                        // radiance that it will deposit
  path_resolved = 4,    // the hit is certain: to be shaded in hit_domain
  path_in_pane = 8,     // inside smooth glass: the face it entered by is known; of a connection: smooth
                        // interfaces refract it
  path_passed = 16,     // went straight on at an event that had the random numbers of its depth; never in a
                        // pane, nor of a connection
  path_unrecorded = 32,  // the film keeps layers of the first surface, and it is yet to be met; as above
  path_seeks = 64,       // not a path yet: looks for what is around its sensor; as above
  path_connected =
      128,  // it was scattered where connections to lights are made from; as above, but in a pane
};

// Of a path in a pane (Path::parts, Path::owes, path_connected).
enum PaneBits : std::uint8_t { pane_parts = 1, pane_owes = 2, pane_connected = 4 };

#pragma pack(push, 1)
// A path on its way to its next hit, with the best hit so far. Or a connection: it ends at hit_t, where its
// light is, without a hit.
struct PathRecord {
  double hit_t;  // ∞: none yet
  std::uint32_t hit_triangle;
  std::uint16_t hit_domain;  // which domain found it
  DirectionCode direction;
  float origin[3];
  std::uint8_t throughput[11];  // as pack_throughput
  std::uint32_t exclude;        // triangle it starts on
  std::uint32_t pixel;
  std::uint32_t sample_depth;  // sample << 9 | high 9 bits of the depth
  std::uint8_t depth;          // its low 8 bits
  std::uint16_t pdf;           // of the last scattering, solid angle, as pdf_code; 0: specular or camera.
                               // In a pane: low 16 bits of the FaceCode; of a connection, of its aim, or
                               // where that is straight of its end_code
  std::uint8_t flags;  // PathFlags; in a pane and of a connection the first 4, and above them the high
                       // bits of the FaceCode or the aim
  // Since the last scattering, straight through surfaces, as radiance_code; in a pane PaneBits in the highest
  // byte. Where images are filtered, a path has the cone_code of its ray's width in the lowest byte. Of a
  // straight connection: what is left to its light, the high bits of the end_code; of one that walks through
  // panes the bits of its PaneWalk.
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
// Of scattering, as it counts beside that of one of several samples of the lights (the balance heuristic,
// Veach 1997, eq. 9.8).
inline float density_beside(double pdf, std::uint32_t light_samples) {
  return pdf_value(pdf_code(static_cast<float>(light_samples == 1 ? pdf : pdf / light_samples)));
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

// A radiance ≥ 0 rounded to 8 bits of exponent and 16 of mantissa: relative error ≤ 2⁻¹⁷.
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

// With 14 bits of mantissa, up or down by chance so that the mean is the value itself: what is multiplied or
// added to at every step of a path would else drift, or stand still. `random`: 16 bits.
inline float rounded_by_chance(float value, std::uint32_t random) {
  const std::uint32_t bits = (std::bit_cast<std::uint32_t>(value) << 1) + (random & 0x3ff);
  return std::bit_cast<float>((bits & ~0x3ffu) >> 1);
}

// Of values that rounded_by_chance has rounded: 22 bits each.
inline void pack_throughput(const SampledSpectrum& s, std::uint8_t out[11]) {
  const auto code = [&](int i) { return std::uint64_t{std::bit_cast<std::uint32_t>(s[i]) >> 9 & 0x3fffff}; };
  const std::uint64_t low = code(0) | code(1) << 22 | code(2) << 44, high = code(2) >> 20 | code(3) << 2;
  std::memcpy(out, &low, 8);
  std::memcpy(out + 8, &high, 3);
}
inline SampledSpectrum unpack_throughput(const std::uint8_t in[11]) {
  std::uint64_t low = 0, high = 0;
  std::memcpy(&low, in, 8);
  std::memcpy(&high, in + 8, 3);
  const auto value = [](std::uint64_t code) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(code & 0x3fffff) << 9);
  };
  return {{value(low), value(low >> 22), value(low >> 44 | high << 20), value(high >> 2)}};
}

// A distance as it travels, by chance too: with 16 bits of mantissa, or 8 beside a cone.
inline float rounded_distance(float value, bool beside_cone, std::uint32_t random) {
  const std::uint32_t dropped = beside_cone ? 0xffff : 0xff;
  const std::uint32_t bits = (std::bit_cast<std::uint32_t>(value) << 1) + (random & dropped);
  return std::bit_cast<float>((bits & ~dropped) >> 1);
}

}  // namespace vitrail
