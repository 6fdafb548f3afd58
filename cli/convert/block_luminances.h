// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace vitrail {

// Pixels of the small pictures that are compared, and how many of a rendered picture make one of them in each
// direction.
struct SmallPicture {
  int width = 0, height = 0;
  static constexpr int block = 8;
};

// Of each pixel of a small picture.
struct Luminances {
  std::vector<double> means;
  std::vector<double> noise;  // standard errors; empty: not known
};

// The mean luminance of each block of a picture of colours in linear sRGB, which is `block` times as large.
// Throws Error where it has another size.
std::vector<double> block_luminances(const std::filesystem::path& picture, SmallPicture size);

// Whether `a` shows what `b` shows: beyond four or five standard errors of what is known of their noise, the
// means differ by no more than `tolerance`, each pixel by no more than five times that. A dark pixel counts
// as a twentieth of the mean.
//
//   {"luminance_ratio": 1.0003, "mean_noise": 0.0007, "worst_pixel": 0.004, "pixel_noise": 0.002,
//   "tolerance":
//    0.02, "passed": true}
//
// Both black: passed, without a ratio. Values of `a` that are no numbers: not passed, with "said".
nlohmann::ordered_json compare_luminances(const Luminances& a, const Luminances& b, double tolerance);

}  // namespace vitrail
