// SPDX-License-Identifier: Apache-2.0
// This file has codes of directions (tracer/rays/direction.h) and of normals (bundle/domain_file.h) in lanes.
#pragma once

#include "tracer/rays/direction.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

// They are the two numbers of a DirectionCode.
template <class U>
struct Code {
  U first, second;
  VITRAIL_LANES DirectionCode of_lane(int j) const {
    return DirectionCode::of(lane(first, j), lane(second, j));
  }
};

namespace detail {

template <class D>
VITRAIL_LANES void fold_if(Mask<D> lower, D& x, D& y) {
  const D folded_x = 1.0 - abs(y), folded_y = 1.0 - abs(x);
  const D other_x = select<D>(x < 0, -folded_x, folded_x), other_y = select<D>(y < 0, -folded_y, folded_y);
  x = select<D>(lower, other_x, x);
  y = select<D>(lower, other_y, y);
}

template <class D>
VITRAIL_LANES WordsLike<D> quantised(D x) {
  return cast_bits<std::uint32_t>(
      convert<std::int32_t>(lanes::clamp<D>((x + 1.0) * 8388607.0, 0.0, 16777214.0) + 0.5));
}

template <class U>
VITRAIL_LANES DoublesLike<U> octahedral(U n) {
  return to_doubles(cast_bits<std::int32_t>(n) - 8388607) * (1 / 8388607.0);
}

}  // namespace detail

template <class D>
VITRAIL_LANES Code<WordsLike<D>> encode_direction(Vector<D> d) {
  const D inverse = 1.0 / (abs(d.x) + abs(d.y) + abs(d.z));
  D x = d.x * inverse, y = d.y * inverse;
  detail::fold_if<D>(d.z < 0, x, y);
  return {detail::quantised(x), detail::quantised(y)};
}

template <class U>
VITRAIL_LANES Vector<FloatsLike<U>> decode_direction(Code<U> code) {
  using D = DoublesLike<U>;
  D x = detail::octahedral(code.first), y = detail::octahedral(code.second);
  const D z = 1.0 - abs(x) - abs(y);
  detail::fold_if<D>(z < 0, x, y);
  const Vector<D> d{x, y, z};
  return to_floats(d * (1.0 / lanes::sqrt(dot(d, d))));
}

template <class U>
VITRAIL_LANES Vector<FloatsLike<U>> decode_normal(U code) {
  using D = DoublesLike<U>;
  const auto both = cast_bits<std::int32_t>(code);
  const D a = to_doubles(cast_bits<std::int32_t>(code << 16) >> 16) / 32767.0,
          b = to_doubles(both >> 16) / 32767.0;
  const D z = 1.0 - abs(a) - abs(b);
  const auto sign = [](D x) __attribute__((always_inline)) {
    return select<D>(x < 0, fill<D>(-1), fill<D>(1));
  };
  const Mask<D> lower = z < 0;
  const D x = select<D>(lower, (1.0 - abs(b)) * sign(a), a),
          y = select<D>(lower, (1.0 - abs(a)) * sign(b), b);
  const D scale = 1.0 / lanes::sqrt(x * x + y * y + z * z);
  return {to_floats(x * scale), to_floats(y * scale), to_floats(z * scale)};
}

}  // namespace
}  // namespace vitrail::lanes
