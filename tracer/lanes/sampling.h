// SPDX-License-Identifier: Apache-2.0
// This file has the random numbers of tracer/sampling/sampler.h in lanes.
#pragma once

#include "film/sample_groups.h"
#include "tracer/sampling/candidate_numbers.h"
#include "tracer/sampling/sampler.h"
#include "tracer/sampling/sobol_tables.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

inline constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ull;

template <class L>
VITRAIL_LANES L mix(L x) {
  x = (x ^ (x >> 30)) * std::uint64_t{0xbf58476d1ce4e5b9};
  x = (x ^ (x >> 27)) * std::uint64_t{0x94d049bb133111eb};
  return x ^ (x >> 31);
}
template <class L>
VITRAIL_LANES L stream_seed(L sample_seed, L a, std::type_identity_t<L> b) {
  return mix(sample_seed + mix(a + std::uint64_t{0x632be59bd9b4e019}) * std::uint64_t{3} + b);
}
template <class U>
VITRAIL_LANES LongsLike<U> sample_seed(std::uint64_t seed, U pixel, U sample) {
  using L = LongsLike<U>;
  const L place = convert<std::uint64_t>(pixel) << 32 | convert<std::uint64_t>(sample);
  return mix(place ^ mix(seed + golden));
}
// Returns the first bits of RandomStream(state).
template <class L>
VITRAIL_LANES L random_bits(L state) {
  return mix(state + golden);
}

namespace detail {

template <class U>
VITRAIL_LANES U reverse_bits(U x) {
  x = x << 24 | (x << 8 & 0x00ff0000u) | (x >> 8 & 0x0000ff00u) | x >> 24;
  x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
  x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
  return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}

template <class U>
VITRAIL_LANES U scramble_reversed(U x, U seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= seed >> 16 | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// Converts integers below 2³¹ that are given as words: the conversion is one instruction.
template <class U>
VITRAIL_LANES FloatsLike<U> small_to_floats(U x) {
  return convert<float>(cast_bits<std::int32_t>(x));
}
template <class U>
VITRAIL_LANES FloatsLike<U> to_unit(U bits) {
  return small_to_floats<U>(bits >> 8) * 0x1p-24f;
}

template <class U>
VITRAIL_LANES U sobol_number(const std::uint32_t* table, U index) {
  return at(table, index & 0xffu) ^ at(table + 256, index >> 8 & 0xffu) ^
         at(table + 512, index >> 16 & 0xffu) ^ at<U>(table + 768, index >> 24);
}

// Returns the second dimension, without its table. It is the sum of (1 + x)ᵏ over the bits k of the index, as
// polynomials over GF(2): five steps of Pascal's triangle.
template <class U>
VITRAIL_LANES U second_number(U index) {
  index ^= index >> 1 & 0x55555555u;
  index ^= index >> 2 & 0x33333333u;
  index ^= index >> 4 & 0x0f0f0f0fu;
  index ^= index >> 8 & 0x00ff00ffu;
  return index ^ index >> 16;
}

template <class U>
VITRAIL_LANES FloatsLike<U> scrambled(U reversed, LongsLike<U> seed) {
  return to_unit(reverse_bits(scramble_reversed(reversed, convert<std::uint32_t>(seed))));
}

inline constexpr const std::uint32_t *third_table = sobol::tables[1][0].data(),
                                     *fourth_table = sobol::tables[2][0].data();

}  // namespace detail

// It is vitrail::sample_4d. Numbers that are not wanted are 0.
template <Wanted wanted = Wanted::four, class U>
VITRAIL_LANES Four<FloatsLike<U>> sample_4d(const PictureSeed& picture, U pixel, U sample,
                                            std::type_identity_t<U> set) {
  using L = LongsLike<U>;
  static_assert(sample_groups == 2);
  const std::uint32_t halves = picture.one_sequence ? 0 : 1;
  const std::uint64_t seed = picture.value;
  const L group = convert<std::uint64_t>(sample & halves), where = convert<std::uint64_t>(pixel) << 32;
  const L h = mix(((where | convert<std::uint64_t>(set)) ^ mix(seed + golden)) +
                  group * std::uint64_t{0x632be59bd9b4e019});
  const U in_group = sample >> halves;
  const U index = detail::reverse_bits(
      detail::scramble_reversed(detail::reverse_bits(in_group), convert<std::uint32_t>(h)));
  const L h2 = mix(h + golden);
  Four<FloatsLike<U>> u{};
  u[0] = detail::scrambled(index, h2);
  u[1] = detail::scrambled(detail::second_number(index), h2 >> 32);
  if constexpr (wanted == Wanted::two) return u;
  const L h3 = mix(h + 2 * golden);
  u[2] = detail::scrambled(detail::sobol_number(detail::third_table, index), h3);
  if constexpr (wanted == Wanted::three) return u;
  u[3] = detail::scrambled(detail::sobol_number(detail::fourth_table, index), h3 >> 32);
  return u;
}

// It is vitrail::numbers_of_candidate, with the same k in all lanes.
template <class F>
VITRAIL_LANES Four<F> numbers_of_candidate(Four<F> u, std::uint32_t k) {
  const CandidateDigits digits = candidate_digits[k];
  const auto flipped = [](F x, std::uint32_t by) __attribute__((always_inline)) {
    return detail::small_to_floats(cast_bits<std::uint32_t>(convert<std::int32_t>(x * 0x1p24f)) ^ by << 20) *
           0x1p-24f;
  };
  return {{flipped(u[0], digits.straight), flipped(u[1], digits.turned), flipped(u[2], digits.straight),
           flipped(u[3], digits.turned)}};
}

}  // namespace
}  // namespace vitrail::lanes
