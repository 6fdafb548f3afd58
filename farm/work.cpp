// SPDX-License-Identifier: Apache-2.0
#include "farm/work.h"

#include <algorithm>

namespace vitrail {

namespace {

std::uint64_t tiles(int extent) {
  return static_cast<std::uint64_t>((extent + WorkPlan::tile - 1) / WorkPlan::tile);
}

}  // namespace

std::uint64_t WorkPlan::tiles_x() const { return tiles(crop.x1 - crop.x0); }
std::uint64_t WorkPlan::tiles_y() const { return tiles(crop.y1 - crop.y0); }

std::uint64_t WorkPlan::items() const {
  return tiles_x() * tiles_y() * ((samples + samples_per_item - 1) / samples_per_item);
}

WorkItem WorkPlan::item(std::uint64_t index) const {
  const std::uint64_t a_pass = tiles_x() * tiles_y(), in_pass = index % a_pass;
  const int x = crop.x0 + static_cast<int>(in_pass % tiles_x()) * tile;
  const int y = crop.y0 + static_cast<int>(in_pass / tiles_x()) * tile;
  const auto sample = static_cast<std::uint32_t>(index / a_pass) * samples_per_item;
  return {{x, std::min(x + tile, crop.x1), y, std::min(y + tile, crop.y1)},
          sample,
          std::min(sample + samples_per_item, samples)};
}

WorkPlan make_work_plan(const PixelRect& crop, std::uint32_t samples) {
  // Few enough items that their list stays small, many enough to share and to stop between.
  return {crop, samples, std::clamp(samples / 128, 1u, 16u)};
}

std::vector<std::uint64_t> share_of(const WorkPlan& plan, const std::vector<std::uint64_t>& done, int rank,
                                    int ranks) {
  std::vector<std::uint64_t> share;
  std::uint64_t open = 0;
  for (std::uint64_t i = 0; i < plan.items(); ++i) {
    if (!done.empty() && (done[i / 64] >> (i % 64) & 1)) continue;
    // A shift by one each row keeps the tiles of a rank from lining up in columns.
    const std::uint64_t row = i / plan.tiles_x();
    if ((open++ + row) % static_cast<std::uint64_t>(ranks) == static_cast<std::uint64_t>(rank))
      share.push_back(i);
  }
  return share;
}

}  // namespace vitrail
