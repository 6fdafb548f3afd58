// SPDX-License-Identifier: Apache-2.0
#include "tracer/sampling/sampler.h"

#include "film/sample_groups.h"
#include "tracer/sampling/sobol_tables.h"

namespace vitrail {

namespace {

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
  using namespace sobol;
  const bool one = key.seed.one_sequence;
  const std::uint64_t group = one ? 0 : group_of(key.sample);
  const std::uint32_t place = one ? key.sample : index_in_group(key.sample);
  const std::uint64_t h =
      mix((mix(key.seed + 0x9e3779b97f4a7c15ull) ^ (static_cast<std::uint64_t>(key.pixel) << 32 | set)) +
          group * 0x632be59bd9b4e019ull);
  // Shuffling is an Owen scramble of the index: every power-of-two prefix stays one aligned, stratified
  // block.
  const std::uint32_t index =
      reverse_bits(scramble_reversed(reverse_bits(place), static_cast<std::uint32_t>(h)));
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
