// SPDX-License-Identifier: Apache-2.0
// What the words of a texel say at the wavelengths of a path.
#pragma once

#include <bit>

#include "bundle/texel.h"
#include "scene/spectra/color.h"
#include "scene/spectra/matrix_r.h"
#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

// x(λ) = Σ l[k]·x_k of the parabola through x at 360, 595 and 830 nm (Lagrange). Of Matrix-R l[k] and
// above[k] are its basis at the bands about the wavelengths; other formats have no `above`.
struct NodeWeights {
  std::array<std::array<float, hero_count>, 3> l, above;
  std::array<float, hero_count> part_above;
  explicit NodeWeights(const SampledWavelengths& wavelengths, TexelFormat format = TexelFormat::reflectance) {
    if (by_matrix_r(format)) {
      for (std::size_t i = 0; i < hero_count; ++i) {
        const MatrixRBasis basis = matrix_r_basis(wavelengths.lambda_nm[i]);
        part_above[i] = basis.part_above;
        for (std::size_t k = 0; k < 3; ++k) l[k][i] = basis.below[k], above[k][i] = basis.above[k];
      }
      return;
    }
    for (std::size_t i = 0; i < hero_count; ++i) {
      const float t = (wavelengths.lambda_nm[i] - 595) * (1.0f / 235);
      l[0][i] = 0.5f * t * (t - 1);
      l[1][i] = 1 - t * t;
      l[2][i] = 0.5f * t * (t + 1);
    }
  }
};

// sum += factor · S
inline void add_sigmoid(const SigmoidNodes& x, const NodeWeights& weights, float factor,
                        SampledSpectrum& sum) {
  const float x0 = x[0], x1 = x[1], x2 = x[2];
#pragma GCC unroll 1  // GCC vectorises loops, but not what is left of them
  for (std::size_t i = 0; i < hero_count; ++i) {
    const float at = weights.l[0][i] * x0 + weights.l[1][i] * x1 + weights.l[2][i] * x2;
    sum.v[i] += factor * (0.5f + at / (2 * std::sqrt(1 + at * at)));
  }
}

inline SampledSpectrum sigmoid_of(const SigmoidNodes& x, const NodeWeights& weights) {
  SampledSpectrum s;
  add_sigmoid(x, weights, 1, s);
  return s;
}

// sum += base + factor · q of Matrix-R
inline void add_matrix_r(const std::array<float, 3>& x, const NodeWeights& weights, float base, float factor,
                         SampledSpectrum& sum) {
  const auto q = [&](const auto& a, std::size_t i) {
    const float at = a[0][i] * x[0] + a[1][i] * x[1] + a[2][i] * x[2];
    return at > 0 ? (at < 1 ? at : 1) : 0;
  };
  for (std::size_t i = 0; i < hero_count; ++i) {
    const float below = q(weights.l, i), above = q(weights.above, i);
    sum.v[i] += base + factor * (below + weights.part_above[i] * (above - below));
  }
}

// Σ factor · texel, of an image of spectra or numbers; D65 is left to the caller.
template <std::size_t N>
SampledSpectrum sum_of(TexelFormat format, const std::array<TexelWords, N>& texels,
                       const std::array<float, N>& factors, const NodeWeights& weights) {
  SampledSpectrum sum;
  // One choice for all of them.
  const auto each = [&](const auto& add) {
    for (std::size_t i = 0; i < N; ++i) add(texels[i], factors[i]);
  };
  const auto third = [](const TexelWords& words) { return std::bit_cast<float>(words[2]); };
  switch (format) {
    case TexelFormat::number:
      each([&](const TexelWords& words, float factor) {
        sum = sum + filled(std::bit_cast<float>(words[0]) * factor);
      });
      break;
    case TexelFormat::reflectance:
      each([&](const TexelWords& words, float factor) {
        add_sigmoid(unpack_nodes(words.data()), weights, factor, sum);
      });
      break;
    case TexelFormat::unbounded:
    case TexelFormat::illuminant:
      each([&](const TexelWords& words, float factor) {
        add_sigmoid(unpack_nodes(words.data()), weights, factor * third(words), sum);
      });
      break;
    case TexelFormat::matrix_r_reflectance:
      each([&](const TexelWords& words, float factor) {
        const float part = third(words);
        add_matrix_r(unpack_nodes(words.data()), weights, factor * (1 - part), factor * part, sum);
      });
      break;
    case TexelFormat::matrix_r_unbounded:
    case TexelFormat::matrix_r_illuminant:
      each([&](const TexelWords& words, float factor) {
        const std::array<float, 3> x = unpack_nodes(words.data());
        const float value = factor * third(words);
        const bool grey = x[0] == 0 && x[1] == 0 && x[2] == 0;
        add_matrix_r(x, weights, grey ? value : 0, value, sum);
      });
      break;
    default:
      break;
  }
  return sum;
}

inline SampledSpectrum spectrum_of(TexelFormat format, const TexelWords& words, const NodeWeights& weights) {
  return sum_of<1>(format, {words}, {1}, weights);
}

// D65 between the two nearest nanometres.
inline SampledSpectrum d65_at(const SampledWavelengths& wavelengths) {
  std::array<int, hero_count> below;
  std::array<float, hero_count> f;
  for (std::size_t i = 0; i < hero_count; ++i) {  // side by side
    const float x = wavelengths.lambda_nm[i] - static_cast<float>(lambda_min_nm);
    const float above = x > 0 ? x : 0, clamped = above < table_size - 1 ? above : table_size - 1;
    const int whole = static_cast<int>(clamped);
    below[i] = whole < table_size - 2 ? whole : table_size - 2;
    f[i] = clamped - static_cast<float>(below[i]);
  }
  const float* const d65 = cie_d65().data();
  SampledSpectrum result;
  for (std::size_t i = 0; i < hero_count; ++i)
    result.v[i] = (1 - f[i]) * d65[below[i]] + f[i] * d65[below[i] + 1];
  return result;
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
