// SPDX-License-Identifier: Apache-2.0
// These are the codes in which the values of rays travel. Values are rounded wherever they are set,
// travelling or not. A ray that is kept is thus bit for bit the one that is sent.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

// It is a pdf ≥ 0 rounded to bfloat16. Both strategies of multiple importance sampling use the rounded value,
// so their weights still add up to 1.
inline std::uint16_t pdf_code(float pdf) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(pdf);
  return static_cast<std::uint16_t>((bits + 0x7fff + ((bits >> 16) & 1)) >> 16);
}
inline float pdf_value(std::uint16_t code) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(code) << 16);
}
// Returns a density of scattering as it counts beside one of several samples of the lights (Veach 1997, eq.
// 9.8).
inline float density_beside(double pdf, std::uint32_t light_samples) {
  return pdf_value(pdf_code(static_cast<float>(light_samples == 1 ? pdf : pdf / light_samples)));
}

// It is a width relative to the scene's scale: 3 bits of mantissa, from 2⁻²⁶ to 2⁶; 0: none.
inline std::uint8_t cone_code(double relative_width) {
  constexpr int least = (127 - 26) << 3;
  const auto bits = static_cast<int>(std::bit_cast<std::uint32_t>(static_cast<float>(relative_width)) >> 20);
  return static_cast<std::uint8_t>(std::clamp(bits - least, 0, 255));
}
inline double cone_value(std::uint8_t code) {
  constexpr std::uint32_t least = (127 - 26) << 3;
  return code == 0 ? 0 : static_cast<double>(std::bit_cast<float>((code + least) << 20));
}

// It is a radiance ≥ 0 rounded to 8 bits of exponent and 16 of mantissa: relative error ≤ 2⁻¹⁷.
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

// Returns the value with 14 bits of mantissa, rounded up or down by chance so that the mean is the value
// itself. Values that are multiplied or added to at every step of a path would otherwise drift, or stand
// still. `random` has 16 bits.
inline float rounded_by_chance(float value, std::uint32_t random) {
  const std::uint32_t bits = (std::bit_cast<std::uint32_t>(value) << 1) + (random & 0x3ff);
  return std::bit_cast<float>((bits & ~0x3ffu) >> 1);
}

// They pack values that rounded_by_chance has rounded: 22 bits each.
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

// Returns a distance as it travels, rounded by chance, too. It has 8 bits of mantissa, since its error only
// changes the density of light samples.
inline float rounded_distance(float value, std::uint32_t random) {
  const std::uint32_t bits = (std::bit_cast<std::uint32_t>(value) << 1) + (random & 0xffff);
  return std::bit_cast<float>((bits & ~0xffffu) >> 1);
}
// They code a distance that is rounded so.
inline std::uint16_t distance_code(float value) {
  return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(value) >> 15);
}
inline float distance_value(std::uint16_t code) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(code) << 15);
}

}  // namespace vitrail
