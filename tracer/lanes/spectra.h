// SPDX-License-Identifier: Apache-2.0
// This file has tracer/sampling/wavelengths.h in lanes: each path has its four wavelengths.
#pragma once

#include "tracer/lanes/sampling.h"
#include "tracer/sampling/flat_spectrum_lanes.h"
#include "tracer/sampling/wavelengths.h"
#include "tracer/simd/spectral_tables.h"

namespace vitrail::lanes {
namespace {

template <class F>
struct Wavelengths {
  Four<F> lambda_nm, pdf;
};
template <class F>
struct SensorXyz {
  Four<F> x, y, z;
};

// Places the hero among the camera's numbers, as vitrail::camera_numbers does.
template <class F>
VITRAIL_LANES void place_hero(Four<F>& u) {
  const F quarter = convert<float>(convert<std::int32_t>(4.0f * u[3]));
  u[2] = lanes::min((u[2] + quarter) / 4.0f, fill<F>(0x1.fffffep-1f));
  u[3] = 4.0f * u[3] - quarter;
}

// It is vitrail::sample_wavelengths by its tables (wavelength_tables()).
template <class F>
VITRAIL_LANES Wavelengths<F> sample_wavelengths(const WavelengthTables& tables, F u) {
  using D = DoublesLike<F>;
  using I = IntsLike<F>;
  Wavelengths<F> result;
  for (int i = 0; i < hero_count; ++i) {
    D v = to_doubles(u) + static_cast<double>(i) / hero_count;
    v = select<D>(v >= 1, v - 1.0, v);
    const I start = cast_bits<std::int32_t>(at(tables.first, convert<std::int32_t>(v * tables.cells)));
    I bin = start & ~WavelengthTables::several;
    const auto beyond = [&](I here) __attribute__((always_inline)) {
      return (here < detail::last_nanometre - 1) & mask_for<I>(at<I>(tables.cumulative, here + 1) <= v);
    };
    bin = select<I>(beyond(bin), bin + 1, bin);  // by no branch, as nobody can guess it
    if (any((start & WavelengthTables::several) != 0))
      for (Mask<I> farther = beyond(bin); any(farther); farther = beyond(bin))
        bin = select<I>(farther, bin + 1, bin);
    const D pdf = at(tables.pdf, bin);
    const D within = lanes::clamp<D>((v - at(tables.cumulative, bin)) / pdf, 0.0, 1.0);
    result.lambda_nm[i] = to_floats(lambda_min_nm + to_doubles(bin) + within);
    result.pdf[i] = to_floats(pdf);
  }
  return result;
}

// Returns the x, y and z of vitrail::sensor_weights. `observer` is &cie_1931()[0][0].
template <class F>
VITRAIL_LANES SensorXyz<F> sensor_weights(const float* observer, const Wavelengths<F>& wavelengths,
                                          DoublesLike<F> scale) {
  const F all = to_floats(scale / (hero_count * cie_y_integral_nm));
  SensorXyz<F> w;
  for (int i = 0; i < hero_count; ++i) {
    const detail::TablePlace<F> place(wavelengths.lambda_nm[i]);
    const F each = all / wavelengths.pdf[i];
    w.x[i] = each * place.in(observer, 3);
    w.y[i] = each * place.in(observer + 1, 3);
    w.z[i] = each * place.in(observer + 2, 3);
  }
  return w;
}

}  // namespace
}  // namespace vitrail::lanes
