// SPDX-License-Identifier: Apache-2.0
#include "film/mattes.h"

#include <algorithm>
#include <functional>
#include <mutex>

namespace vitrail {

namespace {

// But for what is covered.
void add_to_ids(MattePixel& pixel, std::uint32_t id, std::int64_t sum) {
  auto& ids = pixel.ids;
  const auto end = std::ranges::find(ids, 0u);
  const auto at = std::lower_bound(ids.begin(), end, id);
  const auto place = static_cast<std::size_t>(at - ids.begin());
  if (place == most_mattes) return;
  if (ids[place] != id) {
    std::copy_backward(at, ids.end() - 1, ids.end());
    std::copy_backward(pixel.sums.begin() + (at - ids.begin()), pixel.sums.end() - 1, pixel.sums.end());
    ids[place] = id, pixel.sums[place] = 0;
  }
  pixel.sums[place] += sum;
}

}  // namespace

void add(MattePixel& pixel, std::uint32_t id, std::int64_t sum) {
  pixel.covered += sum;
  add_to_ids(pixel, id, sum);
}

void add_shared(MattePixel& pixel, std::uint32_t id, std::int64_t sum) {
  static std::array<std::mutex, 256> locks;  // of pixels that are far from each other
  const std::lock_guard lock(locks[reinterpret_cast<std::uintptr_t>(&pixel) / sizeof(MattePixel) % 256]);
  add(pixel, id, sum);
}

MattePixel& operator+=(MattePixel& a, const MattePixel& b) {
  a.covered += b.covered;
  for (std::size_t i = 0; i < most_mattes && b.ids[i] != 0; ++i) add_to_ids(a, b.ids[i], b.sums[i]);
  return a;
}

bool makes_sense(const MattePixel& pixel) {
  constexpr std::int64_t limit = std::int64_t{1} << 60;  // of 2³² samples there are 2⁴⁸
  const auto is_in_range = [](std::int64_t sum) { return -limit < sum && sum < limit; };
  const auto end = std::ranges::find(pixel.ids, 0u);
  return is_in_range(pixel.covered) && std::ranges::all_of(pixel.sums, is_in_range) &&
         std::adjacent_find(pixel.ids.begin(), end, std::greater_equal()) == end &&
         std::all_of(end, pixel.ids.end(), [](std::uint32_t id) { return id == 0; });
}

}  // namespace vitrail
