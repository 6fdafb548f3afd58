// SPDX-License-Identifier: Apache-2.0
// This file evaluates spectra (flat_spectrum.h) in lanes: each path has its four wavelengths.
#pragma once

#include <limits>

#include "tracer/sampling/flat_spectrum.h"
#include "tracer/simd/spectral_tables.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

// It is a SigmoidSpectrum; c2 may be ±∞.
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

// of(j) is the FlatSpectrum of lane j, which has no `other`. lambda_nm(i) are the wavelengths i of all lanes.
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

}  // namespace
}  // namespace vitrail::lanes
