// SPDX-License-Identifier: Apache-2.0
// This file has Sobol' points by tables of bytes, for sample_4d.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vitrail::sobol {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
  x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
  return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}

// They are the direction numbers v₁…v₃₂ of the first four Sobol' dimensions: primitive polynomials and
// initial values of Joe & Kuo (2008), new-joe-kuo-6.21201. The first dimension is the radical inverse.
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

// It holds the contribution of each byte of the index to each dimension but the first, its bits reversed. A
// number takes 4 exclusive-ors instead of up to 32.
using ByteTable = std::array<std::array<std::uint32_t, 256>, 4>;

constexpr ByteTable byte_table(const Directions& v) {
  ByteTable table{};
  for (std::size_t byte = 0; byte < 4; ++byte)
    for (std::size_t value = 0; value < 256; ++value)
      for (std::size_t bit = 0; bit < 8; ++bit)
        if (value >> bit & 1) table[byte][value] ^= reverse_bits(v[byte * 8 + bit]);
  return table;
}

inline constexpr std::array<ByteTable, 3> tables{byte_table(directions(1, 0, {1, 0, 0})),
                                                 byte_table(directions(2, 1, {1, 3, 0})),
                                                 byte_table(directions(3, 1, {1, 3, 1}))};

}  // namespace vitrail::sobol
