// SPDX-License-Identifier: Apache-2.0
// This file has random numbers, free flights and phase functions of walks within a layer, for any number of
// lanes.
#pragma once

#include <cstdint>

#include "tracer/bsdf/local_lanes.h"
#include "tracer/simd/portable_math_lanes.h"

namespace vitrail::lanes {
namespace {

// It is SplitMix64 (Steele, Lea and Flood 2014), seeded by what a walk depends on. Lanes that are not in `on`
// keep their state.
template <class D>
class WalkRandom {
 public:
  WalkRandom(LongsLike<D> event, std::uint64_t use) : state_(event ^ use) {}
  VITRAIL_LANES WalkRandom& operator<<(D x) {
    state_ = mixed((state_ ^ cast_bits<std::uint64_t>(x)) + step);
    return *this;
  }
  VITRAIL_LANES WalkRandom& operator<<(Vector<D> v) { return *this << v.x << v.y << v.z; }
  // Draws a number of [0, 1).
  VITRAIL_LANES D uniform(Mask<D> on) { return to_doubles(bits(on) >> 11) * 0x1p-53; }
  struct Pair {
    FloatsLike<D> x, y;
  };
  VITRAIL_LANES Pair uniform_pair(Mask<D> on) {
    const auto b = bits(on);
    const auto number = [](LongsLike<D> n) __attribute__((always_inline)) {
      return to_floats(convert<std::int32_t>(n)) * 0x1p-24f;
    };
    return {number(b >> 40), number((b >> 16) & std::uint64_t{0xffffff})};
  }

 private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15u;
  VITRAIL_LANES static LongsLike<D> mixed(LongsLike<D> z) {
    z = (z ^ (z >> 30)) * std::uint64_t{0xbf58476d1ce4e5b9u};
    z = (z ^ (z >> 27)) * std::uint64_t{0x94d049bb133111ebu};
    return z ^ (z >> 31);
  }
  VITRAIL_LANES LongsLike<D> bits(Mask<D> on) {
    const LongsLike<D> next = state_ + step;
    state_ = select<LongsLike<D>>(mask_for<LongsLike<D>>(on), next, state_);
    return mixed(next);
  }
  LongsLike<D> state_;
};

// Returns the transmittance along w of a slab of so many mean free paths.
template <class D>
VITRAIL_LANES D slab_transmittance(D depth, Vector<D> w) {
  const D through = select<D>(w.z != 0, portable_exp(-abs(depth / w.z)), fill<D>(0));
  return select<D>(depth == 0, fill<D>(1), through);
}

// Returns Henyey and Greenstein's (1941) phase function, sr⁻¹; cosine 1 is straight on, |g| < 1.
template <class D>
VITRAIL_LANES D henyey_greenstein(D g, D cosine) {
  const D d = 1.0 + g * g - 2.0 * g * cosine;  // ≥ (1 − |g|)²
  return (1.0 - g * g) / (4 * pi * d * lanes::sqrt(d));
}

// It is portable_math.h's sin_pi for 0 ≤ x < 4.
template <class D>
VITRAIL_LANES D sin_pi(D x) {
  constexpr double round = 0x1.8p52;  // adding it leaves no bits for a fraction
  const D quarters = (2.0 * x + round) - round, r = pi * (x - quarters / 2.0);
  const D turn = select<D>(quarters >= 4, quarters - 4.0, quarters);
  const Mask<D> odd = (turn == 1) | (turn == 3);
  const D value = select<D>(odd, detail::cos_small(r), detail::sin_small(r));
  return select<D>(turn >= 2, -value, value);
}

// Returns a direction in which light that travels along w goes on; its pdf is the phase function.
template <class D>
VITRAIL_LANES Vector<D> sample_henyey_greenstein(D g, Vector<D> w, FloatsLike<D> u_x, FloatsLike<D> u_y) {
  const D x = to_doubles(u_x);
  const D s = (1.0 - g * g) / (1.0 - g + 2.0 * g * x);
  const D cosine =
      select<D>(abs(g) > 1e-3, lanes::clamp<D>((1.0 + g * g - s * s) / (2.0 * g), -1.0, 1.0), 1.0 - 2.0 * x);
  const D sine = safe_sqrt(1.0 - cosine * cosine), phi = 2.0 * to_doubles(u_y);
  return normalize(frame_of(w).to_world({sine * sin_pi<D>(phi + 0.5), sine * sin_pi<D>(phi), cosine}));
}

}  // namespace
}  // namespace vitrail::lanes
