// SPDX-License-Identifier: Apache-2.0
// Which texels of a row a coordinate reads.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "scene/records/texture.h"

namespace vitrail {

// floor without a call of the C library, for |x| < 2³¹.
inline int floor_to_int(double x) {
  const int i = static_cast<int>(x);
  return i - (x < i);
}

// s or t where the image is repeated, so that what follows fits an int; beyond, in [-1, 2].
inline double folded(double s, Wrap wrap) {
  if (!(std::abs(s) < 1e9)) {
    if (!std::isfinite(s)) return 0;
    if (wrap == Wrap::repeat) return s - std::floor(s);
    if (wrap == Wrap::mirror) return s - 2 * std::floor(s / 2);
  }
  if (wrap == Wrap::repeat) return s - floor_to_int(s);
  if (wrap == Wrap::mirror) return s - 2.0 * floor_to_int(s / 2);
  return std::clamp(s, -1.0, 2.0);
}

// The texel that stands for texel i of a row of n, or −1 for black.
inline int wrapped(int i, int n, Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return i < 0 ? i + n : i >= n ? i - n : i;
    case Wrap::mirror:
      if (i < 0) return -1 - i;
      if (i >= 2 * n) return i - 2 * n;
      return i >= n ? 2 * n - 1 - i : i;
    case Wrap::clamp:
      return std::clamp(i, 0, n - 1);
    default:
      return i < 0 || i >= n ? -1 : i;
  }
}

// The two texels of a row whose centres are around a coordinate, and their weights: 0 for black ones, which
// any texel stands for.
struct TexelPair {
  std::array<std::uint32_t, 2> texel;
  std::array<float, 2> weight;
};
inline TexelPair pair_at(double s, int n, Wrap wrap) {
  const double x = folded(s, wrap) * n - 0.5;
  const int below = floor_to_int(x);
  const int i = wrapped(below, n, wrap), j = wrapped(below + 1, n, wrap);
  const auto f = static_cast<float>(x - below);
  return {{static_cast<std::uint32_t>(i < 0 ? 0 : i), static_cast<std::uint32_t>(j < 0 ? 0 : j)},
          {i < 0 ? 0 : 1 - f, j < 0 ? 0 : f}};
}

// The texel of a row at a coordinate, or −1 for black.
inline int single_at(double s, int n, Wrap wrap) {
  return wrapped(floor_to_int(folded(s, wrap) * n), n, wrap);
}

}  // namespace vitrail
