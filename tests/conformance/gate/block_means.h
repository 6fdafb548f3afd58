// SPDX-License-Identifier: Apache-2.0
// Pictures of two renderers, compared by the means of blocks of pixels: each renderer's own scatter over a
// few seeds says by how much they may differ.
#pragma once

#include <string>
#include <vector>

#include "film/film.h"

namespace vitrail::test {

inline constexpr int blocks_a_side = 4;

// X, Y and Z of 4 × 4 blocks by rows.
using BlockMeans = std::vector<double>;
BlockMeans block_means(const Film& film);

struct Tolerance {
  double standard_errors = 7;  // of Student's t with 22 degrees of freedom: 2.5e-7 on each side
  double relative = 0.01;      // of the block
  double of_picture = 0.004;   // of the mean of the picture
};

// Where two sets of seeds differ by more than they may: the worst block, and by how much; "" if nowhere.
std::string difference_of_means(const std::vector<BlockMeans>& a, const std::vector<BlockMeans>& b,
                                const Tolerance& tolerance = {});

}  // namespace vitrail::test
