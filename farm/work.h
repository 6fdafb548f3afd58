// SPDX-License-Identifier: Apache-2.0
// The samples of a picture cut into work items: a tile of pixels and a range of sample numbers. Items are
// numbered alike on every rank, so that a film can say which of them it holds.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace vitrail {

struct WorkItem {
  PixelRect pixels;                        // of the whole film
  std::uint32_t sample0 = 0, sample1 = 0;  // [sample0, sample1)
};

// Sample ranges one after the other, each over all tiles, row by row.
struct WorkPlan {
  PixelRect crop;
  std::uint32_t samples = 0;  // a pixel
  std::uint32_t samples_per_item = 1;
  static constexpr int tile = 16;  // pixels a side

  std::uint64_t tiles_x() const;
  std::uint64_t tiles_y() const;
  std::uint64_t items() const;
  WorkItem item(std::uint64_t index) const;
};

WorkPlan make_work_plan(const PixelRect& crop, std::uint32_t samples);

// The items of `rank` of `ranks` among those not yet done, dealt out in turn, in ascending order.
// `done` holds a bit an item, or is empty: none is.
std::vector<std::uint64_t> share_of(const WorkPlan& plan, const std::vector<std::uint64_t>& done, int rank,
                                    int ranks);

}  // namespace vitrail
