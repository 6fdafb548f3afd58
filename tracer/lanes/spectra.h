// SPDX-License-Identifier: Apache-2.0
// tracer/sampling/wavelengths.h in lanes: each path has its four wavelengths.
#pragma once

#include "tracer/lanes/sampling.h"
#include "tracer/sampling/wavelengths.h"

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

namespace detail {

inline constexpr int last_nanometre = table_size - 1;

// Between the two nearest of 360, 361 … 830 nm.
template <class F>
struct TablePlace {
  IntsLike<F> below;
  F f;
  VITRAIL_LANES explicit TablePlace(F lambda_nm) {
    const F x = lanes::clamp<F>(lambda_nm - static_cast<float>(lambda_min_nm), 0.0f,
                                static_cast<float>(last_nanometre));
    below = lanes::min(convert<std::int32_t>(x), fill<IntsLike<F>>(last_nanometre - 1));
    f = x - to_floats(below);
  }
  VITRAIL_LANES F between(F a, F b) const { return (1.0f - f) * a + f * b; }
  // Of a table with `stride` numbers a nanometre.
  VITRAIL_LANES F in(const float* table, int stride = 1) const {
    return between(at(table, below * stride), at<IntsLike<F>>(table, (below + 1) * stride));
  }
};

}  // namespace detail

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

// Tables of 360, 361 … 830 nm: one for all, or table_of(j) of each lane.
template <class F>
VITRAIL_LANES F table_value(const float* table, F lambda_nm) {
  return detail::TablePlace<F>(lambda_nm).in(table);
}
template <class F, class TableOf>
VITRAIL_LANES F table_value_of_each(const TableOf& table_of, F lambda_nm) {
  const detail::TablePlace<F> place(lambda_nm);
  return place.between(
      gather<F>([&](int j) __attribute__((always_inline)) { return table_of(j)[lane(place.below, j)]; }),
      gather<F>([&](int j) __attribute__((always_inline)) { return table_of(j)[lane(place.below, j) + 1]; }));
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
