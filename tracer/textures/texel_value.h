// SPDX-License-Identifier: Apache-2.0
// These functions turn the words of a texel into values: vectors, and spectra by Matrix-R.
// texel_value_lanes.h has the others.
#pragma once

#include <bit>
#include <span>

#include "bundle/texel.h"
#include "scene/spectra/color.h"
#include "scene/spectra/matrix_r.h"
#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

// It is Matrix-R at the wavelengths of a path: its basis at the bands about each, [basis][wavelength].
struct MatrixRWeights {
  std::array<std::array<float, hero_count>, 3> below, above;
  std::array<float, hero_count> part_above;
  explicit MatrixRWeights(const SampledWavelengths& wavelengths) {
    for (std::size_t i = 0; i < hero_count; ++i) {
      const MatrixRBasis basis = matrix_r_basis(wavelengths.lambda_nm[i]);
      part_above[i] = basis.part_above;
      for (std::size_t k = 0; k < 3; ++k) below[k][i] = basis.below[k], above[k][i] = basis.above[k];
    }
  }
};

// Computes sum += base + factor · q.
inline void add_matrix_r(const std::array<float, 3>& x, const MatrixRWeights& weights, float base,
                         float factor, SampledSpectrum& sum) {
  const auto q = [&](const auto& a, std::size_t i) {
    const float at = a[0][i] * x[0] + a[1][i] * x[1] + a[2][i] * x[2];
    return at > 0 ? (at < 1 ? at : 1) : 0;
  };
  for (std::size_t i = 0; i < hero_count; ++i) {
    const float below = q(weights.below, i), above = q(weights.above, i);
    sum.v[i] += base + factor * (below + weights.part_above[i] * (above - below));
  }
}

// Returns Σ factor · texel for an image by Matrix-R; the caller multiplies by D65.
inline SampledSpectrum sum_of(TexelFormat format, std::span<const TexelWords> texels, const float* factors,
                              const MatrixRWeights& weights) {
  SampledSpectrum sum;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const std::array<float, 3> x = unpack_nodes(texels[i].data());
    const float third = std::bit_cast<float>(texels[i][2]);
    if (format == TexelFormat::matrix_r_reflectance) {
      add_matrix_r(x, weights, factors[i] * (1 - third), factors[i] * third, sum);
    } else {
      const float value = factors[i] * third;
      const bool grey = x[0] == 0 && x[1] == 0 && x[2] == 0;
      add_matrix_r(x, weights, grey ? value : 0, value, sum);
    }
  }
  return sum;
}

inline std::array<double, 3> vector_of(TexelFormat format, const TexelWords& words) {
  const auto part = [&](std::uint32_t word, int shift, std::uint32_t mask) {
    return static_cast<double>((word >> shift) & mask) / mask;
  };
  const auto real = [&](std::size_t i) { return static_cast<double>(std::bit_cast<float>(words[i])); };
  switch (format) {
    case TexelFormat::number:
      return {real(0), real(0), real(0)};
    case TexelFormat::vector_8:
      return {part(words[0], 0, 0xff), part(words[0], 8, 0xff), part(words[0], 16, 0xff)};
    case TexelFormat::vector_16:
      return {part(words[0], 0, 0xffff), part(words[0], 16, 0xffff), part(words[1], 0, 0xffff)};
    case TexelFormat::vector_float:
      return {real(0), real(1), real(2)};
    default:
      return {};
  }
}

}  // namespace vitrail
