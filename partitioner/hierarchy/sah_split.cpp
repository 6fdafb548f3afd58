// SPDX-License-Identifier: Apache-2.0
#include "partitioner/hierarchy/sah_split.h"

#include <algorithm>
#include <bit>

namespace vitrail {

namespace {

using Int4 = std::int32_t __attribute__((vector_size(16)));

constexpr int most_bins = 32;

struct Bins {
  WideBounds box[3][most_bins];
  std::uint32_t count[3][most_bins];
};

}  // namespace

std::optional<SahSplit> choose_split(std::span<const BoxRecord> boxes, const WideBounds& centres,
                                     unsigned block, bool weighted) {
  const int bin_count = static_cast<int>(std::min<std::size_t>(most_bins, 8 + boxes.size() / 32));
  Bins bins;
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(bins.box[axis], bin_count, WideBounds{});
    std::fill_n(bins.count[axis], bin_count, 0u);
  }
  const Float4 size = centres.upper - centres.lower;
  Float4 scale{};
  for (int axis = 0; axis < 3; ++axis) {
    const float s = static_cast<float>(bin_count) / size[axis];
    scale[axis] = s > 0 && s < std::numeric_limits<float>::infinity() ? s : 0;
  }
  const Float4 last = Float4{} + static_cast<float>(bin_count - 1);
  const auto add = [&](const BoxRecord& r) {
    const Float4 lower = r.lower(), upper = r.upper();
    const std::uint32_t weight = weighted ? r.reference : 1;
    const Int4 bin = __builtin_convertvector(min((r.centre() - centres.lower) * scale, last), Int4);
    for (int axis = 0; axis < 3; ++axis) {
      bins.box[axis][bin[axis]].extend(lower, upper);
      bins.count[axis][bin[axis]] += weight;
    }
  };
  // Neighbours share bins, and would wait for each other.
  const std::size_t half = boxes.size() / 2;
  for (std::size_t i = 0; i < half; ++i) add(boxes[i]), add(boxes[half + i]);
  if (boxes.size() % 2) add(boxes.back());
  const int shift = std::countr_zero(block);
  std::optional<SahSplit> best;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  float least = infinity;
  const auto blocks = [&](std::uint32_t n) { return static_cast<float>((n + block - 1) >> shift); };
  for (int axis = 0; axis < 3; ++axis) {
    if (scale[axis] == 0) continue;
    float above[most_bins];  // the cost of bins i and up
    WideBounds box;
    std::uint32_t count = 0;
    for (int i = bin_count - 1; i > 0; --i) {
      box.extend(bins.box[axis][i]);
      count += bins.count[axis][i];
      above[i] = count ? half_area(box.upper - box.lower) * blocks(count) : infinity;
    }
    box = {}, count = 0;
    for (int i = 1; i < bin_count; ++i) {
      box.extend(bins.box[axis][i - 1]);
      count += bins.count[axis][i - 1];
      if (count == 0) continue;
      const float cost = half_area(box.upper - box.lower) * blocks(count) + above[i];
      if (cost >= least) continue;
      least = cost;
      best = SahSplit{axis, centres.lower[axis] + static_cast<float>(i) / scale[axis]};
    }
  }
  return best;
}

}  // namespace vitrail
