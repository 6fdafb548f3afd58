// SPDX-License-Identifier: Apache-2.0
#include "tracer/sampling/sampler.h"

#include "film/sample_groups.h"

namespace vitrail {

namespace {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
  x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
  return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}

// Direction numbers v₁…v₃₂ of the first four Sobol' dimensions: primitive polynomials and initial values of
// Joe & Kuo (2008), new-joe-kuo-6.21201. The first dimension is the radical inverse.
using Directions = std::array<std::uint32_t, 32>;

constexpr Directions directions(int degree, std::uint32_t polynomial, std::array<std::uint32_t, 3> initial) {
  Directions v{};
  for (int i = 0; i < 32; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (i < degree) {
      v[at] = initial[at] << (31 - i);
      continue;
    }
    const auto s = static_cast<std::size_t>(degree);
    v[at] = v[at - s] ^ (v[at - s] >> degree);
    for (int k = 1; k < degree; ++k)
      if (polynomial >> (degree - 1 - k) & 1) v[at] ^= v[at - static_cast<std::size_t>(k)];
  }
  return v;
}

// Contribution of each byte of the index to each dimension, its bits reversed: 4 exclusive-ors a number
// instead of up to 32.
using ByteTable = std::array<std::array<std::uint32_t, 256>, 4>;

constexpr ByteTable byte_table(const Directions& v) {
  ByteTable table{};
  for (std::size_t byte = 0; byte < 4; ++byte)
    for (std::size_t value = 0; value < 256; ++value)
      for (std::size_t bit = 0; bit < 8; ++bit)
        if (value >> bit & 1) table[byte][value] ^= reverse_bits(v[byte * 8 + bit]);
  return table;
}

constexpr std::array<ByteTable, 3> tables{byte_table(directions(1, 0, {1, 0, 0})),
                                          byte_table(directions(2, 1, {1, 3, 0})),
                                          byte_table(directions(3, 1, {1, 3, 1}))};

// An Owen scramble of the bits of x read from the least significant one: each bit is flipped by a hash of the
// bits below it. Constants from N. Vegdahl, "Building a Better LK Hash" (2021).
constexpr std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

float to_unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace

std::array<float, 4> hashed_4d(std::uint64_t seed) {
  std::array<float, 4> result{};
  for (float& x : result) x = to_unit(static_cast<std::uint32_t>(mix(seed += 0x9e3779b97f4a7c15ull) >> 32));
  return result;
}

std::array<float, 4> sample_4d(const SampleKey& key, std::uint32_t set, Wanted wanted) {
  const std::uint64_t group = group_of(key.sample);
  const std::uint64_t h =
      mix((mix(key.seed + 0x9e3779b97f4a7c15ull) ^ (static_cast<std::uint64_t>(key.pixel) << 32 | set)) +
          group * 0x632be59bd9b4e019ull);
  // Shuffling is an Owen scramble of the index: every power-of-two prefix stays one aligned, stratified
  // block.
  const std::uint32_t index = reverse_bits(
      scramble_reversed(reverse_bits(index_in_group(key.sample)), static_cast<std::uint32_t>(h)));
  // Both reversed; the first dimension is the radical inverse.
  const auto point = [&](const ByteTable& t) {
    return t[0][index & 0xff] ^ t[1][index >> 8 & 0xff] ^ t[2][index >> 16 & 0xff] ^ t[3][index >> 24];
  };
  const auto number = [](std::uint32_t bits, std::uint64_t seed) {
    return to_unit(reverse_bits(scramble_reversed(bits, static_cast<std::uint32_t>(seed))));
  };
  const std::uint64_t h2 = mix(h + 0x9e3779b97f4a7c15ull);
  std::array<float, 4> result{number(index, h2), number(point(tables[0]), h2 >> 32)};
  if (wanted == Wanted::two) return result;
  const std::uint64_t h3 = mix(h + 2 * 0x9e3779b97f4a7c15ull);
  result[2] = number(point(tables[1]), h3);
  if (wanted == Wanted::three) return result;
  result[3] = number(point(tables[2]), h3 >> 32);
  return result;
}

}  // namespace vitrail
