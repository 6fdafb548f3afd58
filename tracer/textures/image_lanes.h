// SPDX-License-Identifier: Apache-2.0
// This file has BakedImage's look-ups for any number of lanes. wavelengths(j) are those of lane j; lanes that
// are not set in `lanes` get anything.
#pragma once

#include "tracer/textures/baked_image.h"
#include "tracer/textures/texel_places_lanes.h"
#include "tracer/textures/texel_value_lanes.h"

namespace vitrail::lanes {
namespace {

template <class F, class WavelengthsOf>
VITRAIL_LANES Spectra<F> gather_wavelengths(const WavelengthsOf& wavelengths) {
  Four<F> lambda_nm;
  for (int i = 0; i < hero_count; ++i)
    lambda_nm[i] =
        gather<F>([&](int j) __attribute__((always_inline)) { return wavelengths(j).lambda_nm.data()[i]; });
  return joined(lambda_nm);
}

namespace detail {

template <class F, int N, class WavelengthsOf>
VITRAIL_LANES Four<F> value_of_texels(TexelFormat format, const TexelsOfLanes<N, width<F>>& texels,
                                      const F (&factors)[N], const WavelengthsOf& wavelengths) {
  const Spectra<F> lambda_nm = gather_wavelengths<F>(wavelengths);
  if (format == TexelFormat::bands) return parted(sum_of_bands(texels, factors, lambda_nm));
  Spectra<F> sum = sum_of(format, texels, factors, NodeWeights<F>(lambda_nm));
  if (format == TexelFormat::illuminant) sum = lit(sum, cie_d65().data(), lambda_nm);
  return parted(sum);
}

// Calls of(j), which returns a SampledSpectrum, for each lane.
template <class F, class Of>
VITRAIL_LANES Four<F> lane_by_lane(unsigned lanes, const Of& of) {
  Four<F> result{};
  for (int j = 0; j < width<F>; ++j) {
    if (!(lanes >> j & 1)) continue;
    const SampledSpectrum one = of(j);
    for (int i = 0; i < hero_count; ++i) set_lane(result[i], j, one.v[i]);
  }
  return result;
}

template <class I>
VITRAIL_LANES void store(I v, std::int32_t (&to)[width<I>]) {
  __builtin_memcpy(to, &v, sizeof v);
}

}  // namespace detail

template <class D, class WavelengthsOf>
VITRAIL_LANES Four<FloatsLike<D>> bilinear(const BakedImage& image, D s, D t, Wrap wrap, int level,
                                           unsigned lanes, const WavelengthsOf& wavelengths) {
  using F = FloatsLike<D>;
  using I = IntsLike<D>;
  const BakedImage::Size size = image.size(level);
  if (by_matrix_r(size.format))
    return detail::lane_by_lane<F>(
        lanes, [&](int j) __attribute__((always_inline)) {
          return image.bilinear(lane(s, j), lane(t, j), wrap, level, wavelengths(j));
        });
  const TexelPair<D> h = pair_at(s, fill<I>(size.width), wrap), v = pair_at(t, fill<I>(size.height), wrap);
  std::int32_t x[2][width<D>], y[2][width<D>];
  for (int k = 0; k < 2; ++k) detail::store(h.texel[k], x[k]), detail::store(v.texel[k], y[k]);
  TexelsOfLanes<4, width<D>> texels{};
  image.read_corners(level, lanes, width<D>, x[0], y[0], texels.word[0][0]);
  F factors[4];
  for (int i = 0; i < 4; ++i) factors[i] = h.weight[i % 2] * v.weight[i / 2];
  return detail::value_of_texels(size.format, texels, factors, wavelengths);
}

// 0 ≤ x < width and 0 ≤ y < height of the level, in lanes that are set.
template <class I, class WavelengthsOf>
VITRAIL_LANES Four<Like<float, I>> texel(const BakedImage& image, I x, I y, int level, unsigned lanes,
                                         const WavelengthsOf& wavelengths) {
  using F = Like<float, I>;
  const TexelFormat format = image.size(level).format;
  std::int32_t at_x[width<I>], at_y[width<I>];
  detail::store(x, at_x), detail::store(y, at_y);
  if (by_matrix_r(format))
    return detail::lane_by_lane<F>(
        lanes, [&](int j) __attribute__((always_inline)) {
          return image.texel(at_x[j], at_y[j], level, wavelengths(j));
        });
  TexelsOfLanes<1, width<I>> texels{};
  image.read_texels(level, lanes, width<I>, at_x, at_y, texels.word[0][0]);
  const F one[1] = {fill<F>(1)};
  return detail::value_of_texels(format, texels, one, wavelengths);
}

}  // namespace
}  // namespace vitrail::lanes
