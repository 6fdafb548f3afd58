// SPDX-License-Identifier: Apache-2.0
// These are tables of 360, 361 … 830 nm, read at a wavelength of each lane.
#pragma once

#include "scene/spectra/color.h"
#include "tracer/simd/lanes.h"

namespace vitrail::lanes {
namespace {

namespace detail {

inline constexpr int last_nanometre = table_size - 1;

// It is a place between the two nearest of 360, 361 … 830 nm.
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
  // Returns the value in a table with `stride` numbers a nanometre.
  VITRAIL_LANES F in(const float* table, int stride = 1) const {
    return between(at(table, below * stride), at<IntsLike<F>>(table, (below + 1) * stride));
  }
};

}  // namespace detail

// They read one table for all lanes, or table_of(j) for each lane j.
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

}  // namespace
}  // namespace vitrail::lanes
