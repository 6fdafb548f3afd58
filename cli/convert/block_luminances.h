// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace vitrail {

// A SmallPicture has the pixels of the small pictures that are compared. `block` pixels of a rendered picture
// make one of them in each direction.
struct SmallPicture {
  int width = 0, height = 0;
  static constexpr int block = 8;
};

// These are the luminances of the pixels of a small picture, row by row.
struct Luminances {
  std::vector<double> means;
  std::vector<double> noise;  // standard errors; empty: not known
};

// Returns the mean luminance of each block of a picture of colours in linear sRGB, `block` times as large.
// Throws Error where it has another size.
std::vector<double> block_luminances(const std::filesystem::path& picture, SmallPicture size);

// Says whether `a` shows what `b` shows. The means may differ by `tolerance` and four standard errors, each
// pixel by five times as much and five of its own; noise that is not known is none. A dark pixel counts as a
// twentieth of the mean.
//
//   {"luminance_ratio": 1.0003, "worst_pixel": 0.004, "tolerance": 0.02, "passed": true, "mean_noise":
//   0.0007,
//    "pixel_noise": 0.002}
//
// Both black: passed, without a ratio. Values of `a` that are no numbers: not passed, with "said".
nlohmann::ordered_json compare_luminances(const Luminances& a, const Luminances& b, double tolerance);

}  // namespace vitrail
