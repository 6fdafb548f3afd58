// SPDX-License-Identifier: Apache-2.0
// The texels of a baked image are stored and read in these formats: as 1, 2 or 3 words of 32 bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "scene/spectra/spectrum.h"

namespace vitrail {

// Spectra are kept as x at 360, 595 and 830 nm, of the sigmoid S = ½ + x/(2√(1+x²)): x(λ) is a parabola, so
// it is linear in the three.
enum class TexelFormat : std::uint32_t {
  number,        // a float; as a spectrum: that constant
  vector_8,      // three integers of 8 bits, value = i/255
  vector_16,     // three integers of 16 bits, value = i/65535
  vector_float,  // three floats
  reflectance,   // three Real21: x
  unbounded,     // the same, and a float: scale. Value: scale · S
  illuminant,    // the same times D65
  // These follow Matrix-R (scene/spectra/matrix_r.h): q(λ) = clamp(Σ aₖ(λ)·xₖ, 0, 1), linear between bands of
  // 5 nm. A texel has three Real21, x, and a float w.
  matrix_r_reflectance,  // 1 − w·(1 − q)
  matrix_r_unbounded,    // w·q; w where all of x are 0, a grey
  matrix_r_illuminant,   // the same times D65
  // These are codes, as an image file holds them. They are read as texels of another format (`read_format`).
  // The file has the 256 values that codes of 8 bits stand for.
  color_code,     // three of 8 bits, of linear sRGB; read as reflectance
  number_code,    // one of 8 bits; read as number
  light_code,     // three of 8 bits, of linear sRGB; read as illuminant
  light_code_16,  // three of 16 bits (`value_of_code`), of linear sRGB; read as illuminant
  bands,          // three floats, of linear sRGB: the values in the bands of scene/spectra/rgb_bands.h
  band_code,      // three of 8 bits, of linear sRGB; read as bands
};
inline constexpr std::uint32_t texel_format_count = 16;
inline constexpr std::size_t code_count = 256;

// Returns whether the texels are codes of 8 bits.
constexpr bool is_coded(TexelFormat format) {
  return (format >= TexelFormat::color_code && format <= TexelFormat::light_code) ||
         format == TexelFormat::band_code;
}
// Returns whether the spectra of the texels are found when they are looked up.
constexpr bool finds_spectra(TexelFormat format) {
  return format >= TexelFormat::color_code && format <= TexelFormat::light_code_16 &&
         format != TexelFormat::number_code;
}
constexpr TexelFormat read_format(TexelFormat format) {
  switch (format) {
    case TexelFormat::color_code:
      return TexelFormat::reflectance;
    case TexelFormat::number_code:
      return TexelFormat::number;
    case TexelFormat::light_code:
    case TexelFormat::light_code_16:
      return TexelFormat::illuminant;
    case TexelFormat::band_code:
      return TexelFormat::bands;
    default:
      return format;
  }
}

constexpr bool by_matrix_r(TexelFormat format) {
  return format >= TexelFormat::matrix_r_reflectance && format <= TexelFormat::matrix_r_illuminant;
}
constexpr bool is_illuminant(TexelFormat format) {
  return format == TexelFormat::illuminant || format == TexelFormat::matrix_r_illuminant;
}

// Returns the words of a texel as it is read.
constexpr std::uint32_t words_per_texel(TexelFormat format) {
  switch (format) {
    case TexelFormat::number:
    case TexelFormat::number_code:
    case TexelFormat::vector_8:
      return 1;
    case TexelFormat::vector_16:
    case TexelFormat::reflectance:
    case TexelFormat::color_code:
      return 2;
    default:
      return 3;
  }
}

// Returns the bytes of a texel in the file.
constexpr std::uint32_t bytes_per_texel(TexelFormat format) {
  switch (format) {
    case TexelFormat::number_code:
      return 1;
    case TexelFormat::color_code:
    case TexelFormat::light_code:
    case TexelFormat::band_code:
      return 3;
    case TexelFormat::light_code_16:
      return 6;
    default:
      return 4 * words_per_texel(format);
  }
}

using TexelWords = std::array<std::uint32_t, 3>;  // of which words_per_texel count

// A colour of 8 bits whose spectrum is still to be found is a texel with this last word; the other words are
// unused. The second word of a spectrum is less than 2³¹. So is its third, which is a float that is not
// negative.
constexpr bool is_color_code(std::uint32_t last_word) { return last_word >> 31 != 0; }
constexpr std::uint32_t color_code_word(std::uint32_t r, std::uint32_t g, std::uint32_t b) {
  return 1u << 31 | r | g << 8 | b << 16;
}

// Tiles of all formats take at most 16 KiB.
inline constexpr std::size_t max_tile_words = 4096;
constexpr std::uint32_t tile_width(TexelFormat format) { return words_per_texel(format) == 3 ? 32 : 64; }
constexpr std::uint32_t tile_height(TexelFormat format) { return words_per_texel(format) == 1 ? 64 : 32; }

// A Real21 is a real number in 21 bits: sign, 5 bits of exponent (bias 15), 15 of fraction. It holds 0, and
// magnitudes from 2⁻¹⁴ to real21_max with a relative error below 2⁻¹⁶.
inline constexpr float real21_max = 131070;
// Rounds to nearest even. Greater magnitudes, ±∞ too, become ±real21_max; NaN becomes 0.
inline std::uint32_t encode_real21(float value) {
  if (!(value == value)) return 0;
  const std::uint32_t sign = std::signbit(value) ? 1u << 20 : 0;
  float magnitude = std::min(std::fabs(value), real21_max);
  if (magnitude < 0x1p-15f) return 0;  // the processor may be set to take subnormal numbers for 0
  magnitude = std::max(magnitude, 0x1p-14f);
  // 2⁻¹¹² moves the exponent's bias from 127 to 15.
  const auto bits = std::bit_cast<std::uint32_t>(magnitude * 0x1p-112f);
  return sign | ((bits + 0x7f + ((bits >> 8) & 1)) >> 8);
}
inline float decode_real21(std::uint32_t code) {
  const std::uint32_t magnitude = (code & 0xfffffu) << 8;
  const std::uint32_t sign = (code << 11) & 0x80000000u;
  return std::bit_cast<float>(magnitude | sign) * 0x1p112f;
}

// They are x at 360, 595 and 830 nm of a sigmoid; ±∞ (the constants 1 and 0) becomes ±real21_max, off by
// 2e-11.
using SigmoidNodes = std::array<float, 3>;
SigmoidNodes nodes_of(const SigmoidSpectrum& sigmoid);

struct SpectralTexel {
  std::array<float, 3> x{};
  float scale = 1;
};

inline TexelWords pack(const SpectralTexel& texel) {
  const std::uint64_t bits = static_cast<std::uint64_t>(encode_real21(texel.x[0])) |
                             static_cast<std::uint64_t>(encode_real21(texel.x[1])) << 21 |
                             static_cast<std::uint64_t>(encode_real21(texel.x[2])) << 42;
  return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32),
          std::bit_cast<std::uint32_t>(texel.scale)};
}

inline SigmoidNodes unpack_nodes(const std::uint32_t* words) {
  const std::uint64_t bits = words[0] | static_cast<std::uint64_t>(words[1]) << 32;
  constexpr std::uint64_t mask = (1u << 21) - 1;
  return {decode_real21(static_cast<std::uint32_t>(bits & mask)),
          decode_real21(static_cast<std::uint32_t>((bits >> 21) & mask)),
          decode_real21(static_cast<std::uint32_t>((bits >> 42) & mask))};
}

}  // namespace vitrail
