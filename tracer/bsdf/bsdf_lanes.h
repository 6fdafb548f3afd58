// SPDX-License-Identifier: Apache-2.0
// This file has what bsdf.h has, for any number of lanes. A model that lanes know has its text in its
// *_lanes.h: its .cpp takes one lane of it.
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

// It is vitrail::BsdfValue; both members are 0 where nothing is scattered.
template <class D>
struct BsdfValue {
  Four<FloatsLike<D>> value;
  D pdf;
};

// It is vitrail::BsdfSample, valid where `scatters`.
template <class D>
struct BsdfSample {
  Mask<D> scatters;
  Vector<D> in;
  Four<FloatsLike<D>> weight;
  D pdf;
  Mask<D> specular;
};

namespace detail {

template <class D>
VITRAIL_LANES BsdfValue<D> where(Mask<D> mask, BsdfValue<D> f) {
  using F = FloatsLike<D>;
  const Mask<F> narrow = mask_for<F>(mask);
  for (int i = 0; i < 4; ++i) f.value[i] = select<F>(narrow, f.value[i], fill<F>(0));
  f.pdf = select<D>(mask, f.pdf, fill<D>(0));
  return f;
}

}  // namespace detail

// They return the value or sample of one lane.
template <class D>
VITRAIL_LANES vitrail::BsdfValue lane(const BsdfValue<D>& f, int j) {
  return {lane(f.value, j), lane(f.pdf, j)};
}
template <class D>
VITRAIL_LANES std::optional<vitrail::BsdfSample> lane(const BsdfSample<D>& s, int j) {
  if (!is_set(s.scatters, j)) return std::nullopt;
  return vitrail::BsdfSample{lane(s.in, j), lane(s.weight, j), lane(s.pdf, j), is_set(s.specular, j)};
}

}  // namespace
}  // namespace vitrail::lanes
