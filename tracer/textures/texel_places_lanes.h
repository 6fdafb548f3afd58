// SPDX-License-Identifier: Apache-2.0
// These functions find the texels of a row that a coordinate reads, for any number of lanes.
#pragma once

#include <cmath>

#include "scene/records/texture.h"
#include "tracer/simd/lanes.h"

namespace vitrail::lanes {
namespace {

// Returns floor(x) without a call of the C library, for |x| < 2³¹.
template <class D>
VITRAIL_LANES IntsLike<D> floor_to_int(D x) {
  using I = IntsLike<D>;
  const I i = convert<std::int32_t>(x);
  return i - select<I>(mask_for<I>(x < to_doubles(i)), fill<I>(1), fill<I>(0));
}

namespace detail {

// Folds a number that is not finite, or too large for an int.
inline double folded_far(double s, Wrap wrap) {
  if (!std::isfinite(s)) return 0;
  if (wrap == Wrap::repeat) return s - std::floor(s);
  if (wrap == Wrap::mirror) return s - 2 * std::floor(s / 2);
  return s < 0 ? -1 : 2;
}

}  // namespace detail

// Returns s or t where the image is repeated, so that an int holds what follows; in other modes it is within
// [-1, 2].
template <class D>
VITRAIL_LANES D folded(D s, Wrap wrap) {
  const Mask<D> near = abs(s) < 1e9;
  D place;
  if (wrap == Wrap::repeat)
    place = s - to_doubles(floor_to_int(s));
  else if (wrap == Wrap::mirror)
    place = s - 2.0 * to_doubles(floor_to_int<D>(s / 2.0));
  else
    place = lanes::clamp<D>(s, -1.0, 2.0);
  if (!all(near))
    for (int j = 0; j < width<D>; ++j)
      if (!is_set(near, j)) set_lane(place, j, detail::folded_far(lane(s, j), wrap));
  return place;
}

// Returns the texel that stands for texel i of a row of n, or −1 for black.
template <class I>
VITRAIL_LANES I wrapped(I i, std::type_identity_t<I> n, Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return select<I>(i < 0, i + n, select<I>(i >= n, i - n, i));
    case Wrap::mirror:
      return select<I>(i < 0, -1 - i, select<I>(i >= 2 * n, i - 2 * n, select<I>(i >= n, 2 * n - 1 - i, i)));
    case Wrap::clamp:
      return select<I>(i < 0, fill<I>(0), select<I>(i >= n, n - 1, i));
    default:
      return select<I>((i < 0) | (i >= n), fill<I>(-1), i);
  }
}

// They are the two texels of a row whose centres are around a coordinate, and their weights. A black texel
// has the weight 0, and any texel stands for it.
template <class D>
struct TexelPair {
  IntsLike<D> texel[2];
  FloatsLike<D> weight[2];
};
template <class D>
VITRAIL_LANES TexelPair<D> pair_at(D s, IntsLike<D> n, Wrap wrap) {
  using I = IntsLike<D>;
  using F = FloatsLike<D>;
  const D x = folded(s, wrap) * to_doubles(n) - 0.5;
  const I below = floor_to_int(x);
  const I i = wrapped<I>(below, n, wrap), j = wrapped<I>(below + 1, n, wrap);
  const F f = to_floats(x - to_doubles(below));
  const auto texel = [](I k) __attribute__((always_inline)) { return select<I>(k < 0, fill<I>(0), k); };
  const auto weight = [](I k, F w) __attribute__((always_inline)) {
    return select<F>(mask_for<F>(k < 0), fill<F>(0), w);
  };
  return {{texel(i), texel(j)}, {weight(i, 1.0f - f), weight(j, f)}};
}

// Returns the texel of a row at a coordinate, or −1 for black.
template <class D>
VITRAIL_LANES IntsLike<D> single_at(D s, IntsLike<D> n, Wrap wrap) {
  return wrapped<IntsLike<D>>(floor_to_int<D>(folded(s, wrap) * to_doubles(n)), n, wrap);
}

}  // namespace
}  // namespace vitrail::lanes
