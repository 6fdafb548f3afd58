// SPDX-License-Identifier: Apache-2.0
// A RowPyramid makes of the rows of an image those of all its MIP levels, with a few of each in memory.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "bundle/texture_file.h"
#include "partitioner/appearance/row_halver.h"

namespace vitrail {

class RowPyramid {
 public:
  // `emit` gets the rows of the coarser levels: the level, the row's number from its top, and its values.
  using Emit = std::function<void(std::uint32_t level, std::uint32_t y, std::span<const float> row)>;
  RowPyramid(const TextureFileInfo& info, int channels, Emit emit)
      : info_(info), channels_(channels), emit_(std::move(emit)), next_y_(info.levels) {}

  // Takes the next row of the finest level, from the top.
  void add(std::span<const float> row) { hand_on(0, row); }

 private:
  void hand_on(std::uint32_t level, std::span<const float> row) {
    if (level + 1 == info_.levels) return;
    if (halvers_.size() <= level)
      halvers_.emplace_back(static_cast<int>(std::max(info_.width >> level, 1u)),
                            static_cast<int>(std::max(info_.height >> level, 1u)), channels_);
    halvers_[level].add(row, [&](std::span<const float> half) {
      emit_(level + 1, next_y_[level + 1]++, half);
      hand_on(level + 1, half);
    });
  }

  TextureFileInfo info_;
  int channels_;
  Emit emit_;
  std::vector<std::uint32_t> next_y_;  // of each level
  std::deque<RowHalver> halvers_;      // of each level but the last; they stay where they are
};

}  // namespace vitrail
