// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/records/texture.h"

namespace vitrail {

class BakedImage;

// They are values in [least, most]. `mean` may be a guess. It is 0 where `most` is: all values are then 0 or
// less.
struct ValueRange {
  double least = 0, mean = 0, most = 0;
};

struct Interval {
  double low = 0, high = 0;
};

// It gives the range of an image in any part of it: luminances, or numbers of an image of numbers. Every
// texel counts, in means over cells of a grid, over four of them, and so on.
class ImageSums {
 public:
  // `most_cells` is the number along a side, a power of two.
  ImageSums(const BakedImage& image, int most_cells);

  // Returns the range where (s,t) is in the box. `interpolated` says that lookups reach the next texel.
  ValueRange over(Interval s, Interval t, Wrap wrap, bool interpolated) const;

 private:
  struct Level {
    int width = 1, height = 1;
    std::vector<double> means;  // row by row from the bottom
  };
  void add_texels(const BakedImage& image);

  int width_, height_;  // of the image
  std::vector<Level> levels_;
  double least_ = 0, most_ = 0;
};

}  // namespace vitrail
