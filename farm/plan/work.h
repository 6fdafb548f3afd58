// SPDX-License-Identifier: Apache-2.0
// The samples of a picture are cut into work items: a tile of pixels and a range of sample numbers. Items are
// numbered alike on every rank, so that a film can say which of them it holds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

struct WorkItem {
  PixelRect pixels;                        // of the whole film
  std::uint32_t sample0 = 0, sample1 = 0;  // [sample0, sample1)
};

// It has sample ranges one after the other, each over all tiles, row by row. A render that goes on from one
// of fewer samples keeps that one's items and puts its own behind them: a part for each.
//
// In an adaptive round each pixel has samples of its own number: `held` by the film before the round, `more`
// in it. A part then counts from the first of these, and its items end where a pixel's end.
struct WorkPlan {
  struct Part {
    std::uint32_t first = 0, end = 0;  // samples of a pixel: [first, end)
    std::uint32_t samples_per_item = 1;
  };
  PixelRect crop;
  std::vector<Part> parts;
  std::vector<std::uint32_t> held, more;  // a pixel of the crop, row by row; empty: all pixels alike
  bool one_by_one = false;                // an item has one sample of each of its pixels
  static constexpr int tile = 16;         // pixels a side

  std::uint32_t samples() const { return parts.back().end; }  // a pixel, at most
  std::uint64_t all_samples() const;                          // of all pixels together, those held included
  bool adaptive() const { return !more.empty(); }
  std::uint64_t tiles_x() const;
  std::uint64_t tiles_y() const;
  std::uint64_t items() const;
  WorkItem item(std::uint64_t index) const;

  struct Range {
    std::uint32_t first = 0, end = 0;
  };
  // Returns the samples of a pixel in an item, by number.
  Range samples(const WorkItem& item, int x, int y) const;
  std::uint64_t samples(const WorkItem& item) const;  // of all its pixels
};

// Makes the plan. `earlier_ends` are the samples a pixel of the renders that it goes on from, ascending,
// below `samples`.
WorkPlan make_work_plan(const PixelRect& crop, std::uint32_t samples,
                        std::span<const std::uint32_t> earlier_ends = {}, bool one_by_one = false);

// Makes the plan of an adaptive round: `held` and `more` are as in WorkPlan.
WorkPlan make_adaptive_round(const PixelRect& crop, std::vector<std::uint32_t> held,
                             std::vector<std::uint32_t> more);

// Marks the items of an adaptive round that have no samples as done: `done` has a bit an item.
void mark_empty_items(const WorkPlan& plan, std::vector<std::uint64_t>& done);

// Returns bits that say that every item is done, one each, in words of 64.
std::vector<std::uint64_t> all_done(std::uint64_t items);

// Visits the samples [first, end) of an item, pixel by pixel: visit(x, y, sample).
template <class Visit>
void for_each_sample(const WorkPlan& plan, const WorkItem& item, std::uint64_t first, std::uint64_t end,
                     const Visit& visit) {
  std::uint64_t at = 0;
  for (int y = item.pixels.y0; y < item.pixels.y1; ++y)
    for (int x = item.pixels.x0; x < item.pixels.x1; ++x) {
      const auto [sample0, sample1] = plan.samples(item, x, y);
      const std::uint64_t before = at;
      at += sample1 - sample0;
      for (std::uint64_t i = std::max(first, before); i < std::min(end, at); ++i)
        visit(x, y, sample0 + static_cast<std::uint32_t>(i - before));
    }
}

// Puts the items of a tile in some successive passes behind each other, in a share in ascending order:
// workers take them together (tasks.cpp). The first passes stay alone, so that a picture is soon seen whole.
void put_passes_together(const WorkPlan& plan, std::vector<std::uint64_t>& items);
// Returns whether a worker may take `next` with `item`: it has the next samples of the same pixels.
bool goes_on_with(const WorkPlan& plan, const WorkItem& item, const WorkItem& next);

// Returns the bytes of memory for a rank's share of the items by number, and a bit of each, twice. Photon
// mapping lists those of an iteration at a time.
std::uint64_t list_bytes(const WorkPlan& plan, int ranks);

// Returns the items of `rank` of `ranks` among those of [first, end) that are not yet done. They are dealt
// out in turn, and ascend. `done` holds a bit an item, or is empty: none is.
std::vector<std::uint64_t> share_of(const std::vector<std::uint64_t>& done, std::uint64_t first,
                                    std::uint64_t end, int rank, int ranks);
// Returns the share of all of a plan's items.
std::vector<std::uint64_t> share_of(const WorkPlan& plan, const std::vector<std::uint64_t>& done, int rank,
                                    int ranks);

}  // namespace vitrail
