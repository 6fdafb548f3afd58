// SPDX-License-Identifier: Apache-2.0
// This file has the radiance of a sky's model (scene/daylight/sky_model.h) at the wavelengths of paths, for
// any number of lanes, without the sun's disc. All bands of a lane are worked out side by side.
#pragma once

#include "scene/daylight/sky_model.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

namespace detail {

// It is a place for BandCurves::at: the segment, and t in it.
template <class D>
struct CurvePlace {
  IntsLike<D> segment;
  FloatsLike<D> t;
};
template <class D>
VITRAIL_LANES CurvePlace<D> place_on_curve(D x, int segments) {
  using I = IntsLike<D>;
  const D place = select<D>(x > 0, x * static_cast<double>(segments), fill<D>(0));
  const I segment = lanes::min(convert<std::int32_t>(place), fill<I>(segments - 1));
  return {segment, to_floats(place - to_doubles(segment))};
}

// Returns the place of an angle by its cosine, as SkyModel does for its scattering.
template <class D>
VITRAIL_LANES D place_of_angle(D cosine) {
  const D near = lanes::sqrt(D(1.0 - lanes::abs(cosine))) / 2.0;
  return select<D>(cosine < 0, 1.0 - near, near);
}

// It holds four bands from `b` on.
using FourBands = Floats<4>;
VITRAIL_LANES FourBands bands_of(const float* p, std::size_t b) {
  FourBands bands;
  __builtin_memcpy(&bands, p + b, sizeof bands);
  return bands;
}
VITRAIL_LANES FourBands on_curve(const BandCurves::Table& curve, int segment, float t, std::size_t b) {
  const float* const c =
      curve.coefficient + static_cast<std::size_t>(segment) * BandCurves::powers * band_lanes;
  return bands_of(c, b) + t * (bands_of(c + band_lanes, b) +
                               t * (bands_of(c + 2 * band_lanes, b) + t * bands_of(c + 3 * band_lanes, b)));
}

// It holds all bands of each lane, relative to each band's mean.
template <int W>
struct SkyBands {
  alignas(16) float value[W][band_lanes];
};

// Returns the radiance at a wavelength: between the two nearest bands.
template <class D>
VITRAIL_LANES FloatsLike<D> between_bands(const double* radiance, const SkyBands<width<D>>& bands,
                                          FloatsLike<D> lambda_nm) {
  using I = IntsLike<D>;
  const D x = (to_doubles(lambda_nm) - first_sky_band_nm) / sky_band_step_nm;
  const D above = select<D>(x > 0, x, fill<D>(0));
  const D held = select<D>(above < sky_bands - 1, above, fill<D>(sky_bands - 1));
  const I low = lanes::min(convert<std::int32_t>(held), fill<I>(sky_bands - 2));
  const auto value = [&](int step) __attribute__((always_inline)) {
    return gather<D>([&](int j) __attribute__((always_inline)) {
      const int band = lane(low, j) + step;
      return static_cast<double>(bands.value[j][band]) * radiance[band];
    });
  };
  const D a = value(0), b = value(1);
  return to_floats(a + (b - a) * (held - to_doubles(low)));
}

}  // namespace detail

// It is SkyModel::sky, in the lanes that are `on`, else 0. d is unit, in the light's frame; wavelengths(j)
// are those of lane j.
template <class D, class WavelengthsOf>
VITRAIL_LANES Four<FloatsLike<D>> sky_towards(const SkyModel& sky, Vector<D> d, Mask<D> on,
                                              const WavelengthsOf& wavelengths) {
  using F = FloatsLike<D>;
  constexpr int W = width<D>;
  Four<F> radiance{};
  const Mask<D> shines = on & (d.z >= 0);
  const SkyModel::Curves curves = sky.curves();
  if (!curves.gradient.coefficient || !any(shines)) return radiance;
  const D root = lanes::sqrt(lanes::max(fill<D>(0), d.z));
  const detail::CurvePlace<D> height = detail::place_on_curve(root, curves.gradient.segments),
                              beside_sun =
                                  detail::place_on_curve(detail::place_of_angle(lanes::clamp<D>(
                                                             dot(d, fill<D>(sky.to_sun())), -1.0, 1.0)),
                                                         curves.scattering.segments);
  const F root_float = to_floats(root);
  detail::SkyBands<W> bands;
  for (int j = 0; j < W; ++j)
    for (std::size_t b = 0; b < band_lanes; b += 4) {
      using detail::FourBands;
      const FourBands gradient =
                          detail::on_curve(curves.gradient, lane(height.segment, j), lane(height.t, j), b),
                      scattering = detail::on_curve(curves.scattering, lane(beside_sun.segment, j),
                                                    lane(beside_sun.t, j), b);
      const FourBands value =
          gradient * (scattering + detail::bands_of(curves.horizon, b) * lane(root_float, j));
      const FourBands bright = select<FourBands>(value > 0, value, FourBands{});
      __builtin_memcpy(bands.value[j] + b, &bright, sizeof bright);
    }
  for (int i = 0; i < hero_count; ++i) {
    const F lambda_nm =
        gather<F>([&](int j) __attribute__((always_inline)) { return wavelengths(j).lambda_nm.data()[i]; });
    radiance[i] =
        select<F>(mask_for<F>(shines), detail::between_bands<D>(curves.radiance, bands, lambda_nm), F{});
  }
  return radiance;
}

}  // namespace
}  // namespace vitrail::lanes
