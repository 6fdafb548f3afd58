// SPDX-License-Identifier: Apache-2.0
// Mattes say which things a pixel shows and how much of it each covers: masks for compositors. Sums are whole
// numbers, so that pixels merge in any order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vitrail {

// A pixel keeps at most so many things, in the order of their ids. If there are more, the ids alone decide
// which have no place. So a thing that is kept in the end was kept always, however samples are put together.
inline constexpr std::size_t most_mattes = 8;

struct MattePixel {
  std::int64_t covered = 0;                      // by all things, also those that have no place
  std::array<std::int64_t, most_mattes> sums{};  // in 2^-weight_bits of a sample (footprint.h)
  std::array<std::uint32_t, most_mattes> ids{};  // ascending; then 0: none
  bool operator==(const MattePixel&) const = default;
};
static_assert(sizeof(MattePixel) == 8 * (1 + most_mattes) + 4 * most_mattes);

// Adds `sum` to the thing `id` ≠ 0.
void add(MattePixel& pixel, std::uint32_t id, std::int64_t sum);
// Adds the same, safe from many threads at once.
void add_shared(MattePixel& pixel, std::uint32_t id, std::int64_t sum);
MattePixel& operator+=(MattePixel& a, const MattePixel& b);

// Returns whether samples can have made it. It is for files; the bound leaves room for the sums of two.
bool makes_sense(const MattePixel& pixel);

}  // namespace vitrail
