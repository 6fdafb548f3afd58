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

// The mean luminance of each block of a picture of colours in linear sRGB, which is `block` times as large.
// Throws Error where it has another size.
std::vector<double> block_luminances(const std::filesystem::path& picture, SmallPicture size);

// Whether `a` shows what `b` shows: the means differ by no more than `tolerance`, each pixel by no more than
// five times that. A dark pixel counts as a twentieth of the mean.
//
//   {"luminance_ratio": 1.0003, "worst_pixel": 0.004, "tolerance": 0.02, "passed": true}
//
// Both black: passed, without a ratio. Values of `a` that are no numbers: not passed, with "said".
nlohmann::ordered_json compare_luminances(const std::vector<double>& a, const std::vector<double>& b,
                                          double tolerance);

}  // namespace vitrail
