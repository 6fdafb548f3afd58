// SPDX-License-Identifier: Apache-2.0
// The samples of a picture cut into work items: a tile of pixels and a range of sample numbers. Items are
// numbered alike on every rank, so that a film can say which of them it holds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace vitrail {

struct WorkItem {
  PixelRect pixels;                        // of the whole film
  std::uint32_t sample0 = 0, sample1 = 0;  // [sample0, sample1)
};

// Sample ranges one after the other, each over all tiles, row by row. A render that goes on from one of fewer
// samples keeps that one's items and puts its own behind them: a part for each.
struct WorkPlan {
  struct Part {
    std::uint32_t first = 0, end = 0;  // samples of a pixel: [first, end)
    std::uint32_t samples_per_item = 1;
  };
  PixelRect crop;
  std::vector<Part> parts;
  static constexpr int tile = 16;  // pixels a side

  std::uint32_t samples() const { return parts.back().end; }  // a pixel
  std::uint64_t tiles_x() const;
  std::uint64_t tiles_y() const;
  std::uint64_t items() const;
  WorkItem item(std::uint64_t index) const;
};

// `earlier_ends`: the samples a pixel of the renders that it goes on from, ascending, below `samples`.
WorkPlan make_work_plan(const PixelRect& crop, std::uint32_t samples,
                        std::span<const std::uint32_t> earlier_ends = {});

// The items of `rank` of `ranks` among those not yet done, dealt out in turn, in ascending order.
// `done` holds a bit an item, or is empty: none is.
std::vector<std::uint64_t> share_of(const WorkPlan& plan, const std::vector<std::uint64_t>& done, int rank,
                                    int ranks);

}  // namespace vitrail
