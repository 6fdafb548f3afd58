// SPDX-License-Identifier: Apache-2.0
// These functions turn the words of texels into values at the wavelengths of paths, for any number of lanes:
// numbers and sigmoids. Matrix-R is in texel_value.h.
#pragma once

#include "bundle/texel.h"
#include "scene/spectra/rgb_bands.h"
#include "tracer/simd/several.h"
#include "tracer/simd/spectral_tables.h"

namespace vitrail::lanes {
namespace {

// They are the weights of x(λ) = Σ l[k]·x_k, the parabola through x at 360, 595 and 830 nm (Lagrange).
template <class F>
struct NodeWeights {
  Spectra<F> l[3];
  VITRAIL_LANES explicit NodeWeights(const Spectra<F>& lambda_nm) {
    for (int g = 0; g < Spectra<F>::count; ++g) {
      const Several<F> t = (lambda_nm.v[g] - 595.0f) * (1.0f / 235);
      l[0].v[g] = 0.5f * t * (t - 1.0f);
      l[1].v[g] = 1.0f - t * t;
      l[2].v[g] = 0.5f * t * (t + 1.0f);
    }
  }
};

// They are the words of N texels a lane, those that the format has.
template <int N, int W>
struct TexelsOfLanes {
  alignas(4 * W) std::uint32_t word[N][3][W];
  VITRAIL_LANES Words<W> words(int texel, int k) const {
    Words<W> result;
    __builtin_memcpy(&result, word[texel][k], sizeof result);
    return result;
  }
};

namespace detail {

// It is vitrail::decode_real21.
template <class U>
VITRAIL_LANES FloatsLike<U> decode_real21(U code) {
  return cast_bits<float>((code & 0xfffffu) << 8 | ((code << 11) & 0x80000000u)) * 0x1p112f;
}

// Computes sum += factor · S.
template <class F>
VITRAIL_LANES void add_sigmoid(const F (&x)[3], const NodeWeights<F>& weights, F factor, Spectra<F>& sum) {
  using S = Several<F>;
  const S x0 = repeated(x[0]), x1 = repeated(x[1]), x2 = repeated(x[2]), f = repeated(factor);
  for (int g = 0; g < Spectra<F>::count; ++g) {
    const S at = weights.l[0].v[g] * x0 + weights.l[1].v[g] * x1 + weights.l[2].v[g] * x2;
    sum.v[g] = sum.v[g] + f * (0.5f + at / (2.0f * lanes::sqrt<S>(1.0f + at * at)));
  }
}

}  // namespace detail

// Returns 0.5 + x/(2√(1+x²)) of x at the three nodes.
template <class F>
VITRAIL_LANES Spectra<F> sigmoid_of_nodes(const F (&x)[3], const NodeWeights<F>& weights) {
  Spectra<F> s{};
  detail::add_sigmoid(x, weights, fill<F>(1), s);
  return s;
}

// Returns Σ factor · texel for an image by bands.
template <class F, int N>
VITRAIL_LANES Spectra<F> sum_of_bands(const TexelsOfLanes<N, width<F>>& texels, const F (&factors)[N],
                                      const Spectra<F>& lambda_nm) {
  using S = Several<F>;
  F c[3] = {fill<F>(0), fill<F>(0), fill<F>(0)};
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < 3; ++k) c[k] = c[k] + cast_bits<float>(texels.words(i, k)) * factors[i];
  const S red = repeated(c[0]), green = repeated(c[1]), blue = repeated(c[2]);
  Spectra<F> sum{};
  for (int g = 0; g < Spectra<F>::count; ++g)
    sum.v[g] = select(lambda_nm.v[g] < static_cast<float>(green_begins_nm), blue,
                      select(lambda_nm.v[g] < static_cast<float>(red_begins_nm), green, red));
  return sum;
}

// Returns Σ factor · texel for an image of spectra or numbers, not by Matrix-R or bands; the caller
// multiplies by D65.
template <class F, int N>
VITRAIL_LANES Spectra<F> sum_of(TexelFormat format, const TexelsOfLanes<N, width<F>>& texels,
                                const F (&factors)[N], const NodeWeights<F>& weights) {
  Spectra<F> sum{};
  if (format == TexelFormat::number) {
    F one = fill<F>(0);
    for (int i = 0; i < N; ++i) one = one + cast_bits<float>(texels.words(i, 0)) * factors[i];
    for (int g = 0; g < Spectra<F>::count; ++g) sum.v[g] = repeated(one);
    return sum;
  }
  const bool scaled = format != TexelFormat::reflectance;
  if (scaled && format != TexelFormat::unbounded && format != TexelFormat::illuminant) return sum;
  for (int i = 0; i < N; ++i) {
    const auto low = texels.words(i, 0), high = texels.words(i, 1);
    const F x[3] = {detail::decode_real21(low & 0x1fffffu),
                    detail::decode_real21((low >> 21 | high << 11) & 0x1fffffu),
                    detail::decode_real21(high >> 10 & 0x1fffffu)};
    const F factor = scaled ? factors[i] * cast_bits<float>(texels.words(i, 2)) : factors[i];
    detail::add_sigmoid(x, weights, factor, sum);
  }
  return sum;
}

// Returns the light of an image of light: its value times `d65`, which is cie_d65().
template <class F>
VITRAIL_LANES Spectra<F> lit(const Spectra<F>& value, const float* d65, const Spectra<F>& lambda_nm) {
  Spectra<F> result;
  for (int g = 0; g < Spectra<F>::count; ++g) result.v[g] = value.v[g] * table_value(d65, lambda_nm.v[g]);
  return result;
}

}  // namespace
}  // namespace vitrail::lanes
