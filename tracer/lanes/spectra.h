// SPDX-License-Identifier: Apache-2.0
// tracer/sampling/wavelengths.h in lanes: each path has its four wavelengths.
#pragma once

#include "tracer/lanes/sampling.h"
#include "tracer/sampling/flat_spectrum.h"
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

// SigmoidSpectrum; c2 may be ±∞.
template <class D>
VITRAIL_LANES FloatsLike<D> sigmoid(D c0, D c1, D c2, std::type_identity_t<FloatsLike<D>> lambda_nm) {
  using F = FloatsLike<D>;
  const D l = to_doubles(lambda_nm), y = (c0 * l + c1) * l + c2;
  const D above = select<D>(y < -1e18, fill<D>(-1e18), y);
  const F x = to_floats(select<D>(above > 1e18, fill<D>(1e18), above));
  const F root = lanes::sqrt(1.0f + x * x), rest = 0.5f / (root * (root + abs(x)));
  const F value = select<F>(x < 0, rest, 1.0f - rest);
  const Mask<F> constant = mask_for<F>(abs(c2) > std::numeric_limits<double>::max());
  return select<F>(constant, select<F>(x > 0, fill<F>(1), fill<F>(0)), value);
}

// Of the camera's numbers, as vitrail::camera_numbers has it.
template <class F>
VITRAIL_LANES void place_hero(Four<F>& u) {
  const F quarter = convert<float>(convert<std::int32_t>(4.0f * u[3]));
  u[2] = lanes::min((u[2] + quarter) / 4.0f, fill<F>(0x1.fffffep-1f));
  u[3] = 4.0f * u[3] - quarter;
}

// of(j): the FlatSpectrum of lane j, which has no `other`. lambda_nm(i): the wavelengths i of all lanes.
template <class D, class SpectrumOf, class LambdaOf>
VITRAIL_LANES Four<FloatsLike<D>> flat_values(const SpectrumOf& of, const LambdaOf& lambda_nm) {
  using F = FloatsLike<D>;
  const auto number = [&](float FlatSpectrum::*part) __attribute__((always_inline)) {
    return gather<F>([&](int j) __attribute__((always_inline)) { return of(j).*part; });
  };
  const D c0 = to_doubles(number(&FlatSpectrum::c0)), c1 = to_doubles(number(&FlatSpectrum::c1)),
          c2 = to_doubles(number(&FlatSpectrum::c2));
  const F scale = number(&FlatSpectrum::scale), factor = number(&FlatSpectrum::factor);
  const auto table = [&](int j) __attribute__((always_inline)) { return of(j).table; };
  bool has_tables = false;
  for (int j = 0; j < width<D>; ++j) has_tables |= of(j).has_table;
  Four<F> values;
  for (int i = 0; i < hero_count; ++i) values[i] = sigmoid(c0, c1, c2, lambda_nm(i));
  if (has_tables)
    for (int i = 0; i < hero_count; ++i) values[i] = values[i] * table_value_of_each<F>(table, lambda_nm(i));
  for (int i = 0; i < hero_count; ++i) values[i] = values[i] * scale * factor;
  return values;
}

// vitrail::sample_wavelengths by its tables (wavelength_tables()).
template <class F>
VITRAIL_LANES Wavelengths<F> sample_wavelengths(const WavelengthTables& tables, F u) {
  using D = DoublesLike<F>;
  using I = IntsLike<F>;
  Wavelengths<F> result;
  for (int i = 0; i < hero_count; ++i) {
    D v = to_doubles(u) + static_cast<double>(i) / hero_count;
    v = select<D>(v >= 1, v - 1.0, v);
    I bin = cast_bits<std::int32_t>(at(tables.first, convert<std::int32_t>(v * tables.cells)));
    for (;;) {
      const Mask<I> beyond =
          (bin < detail::last_nanometre - 1) & mask_for<I>(at<I>(tables.cumulative, bin + 1) <= v);
      if (!any(beyond)) break;
      bin = select<I>(beyond, bin + 1, bin);
    }
    const D pdf = at(tables.pdf, bin);
    const D within = lanes::clamp<D>((v - at(tables.cumulative, bin)) / pdf, 0.0, 1.0);
    result.lambda_nm[i] = to_floats(lambda_min_nm + to_doubles(bin) + within);
    result.pdf[i] = to_floats(pdf);
  }
  return result;
}

// The x, y and z of vitrail::sensor_weights. `observer`: &cie_1931()[0][0].
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
