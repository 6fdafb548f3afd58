// SPDX-License-Identifier: Apache-2.0
// A RowHalver makes of the rows of an image those of one half as large, with a few of them in memory.
#pragma once

#include <deque>
#include <functional>
#include <span>
#include <vector>

namespace vitrail {

// Sizes are halved and rounded down, but at least 1: each pixel is the mean of its part of the image.
class RowHalver {
 public:
  RowHalver(int width, int height, int channels);

  // Adds the next row from the top. `emit` gets each row of the half that is complete with it.
  void add(std::span<const float> row, const std::function<void(std::span<const float>)>& emit);

 private:
  int width_, height_, channels_;
  int taken_ = 0, emitted_ = 0;          // rows
  int first_ = 0;                        // number of the first row that is kept
  std::deque<std::vector<float>> kept_;  // narrow already
};

}  // namespace vitrail
