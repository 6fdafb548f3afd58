// SPDX-License-Identifier: Apache-2.0
// One comparison from end to end: the value of a metric, the verdict, and where the errors are.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compare/metrics.h"
#include "compare/welch.h"
#include "compare/ztest.h"

namespace vitrail {

enum class Metric { relmse, mse, rmse, mae, psnr, smape, flip, ztest, bitwise, ssim, welch };

// Empty for an unknown name.
std::optional<Metric> metric_of(const std::string& name);
const std::vector<std::string>& metric_names();

// A pixel of great error.
struct WorstPixel {
  int x = 0, y = 0;  // in the whole picture
  std::array<float, 3> image{}, reference{};
  double error = 0;  // of the metric
};

// What a comparison found.
struct Comparison {
  Metric metric = Metric::relmse;
  // For ztest the fraction of values that fail, for bitwise of pixels that differ, for welch the distance of
  // its p-values from evenly spread ones.
  double value = 0;
  std::optional<double> threshold, mean_within;
  // All of these hold: value ≤ threshold; the means of X, Y and Z differ by no more than the fraction
  // mean_within (without one, ztest tests the means too); every pixel is finite in both images. Without a
  // threshold and a fraction nothing is judged.
  bool passed = true;
  bool judged() const { return threshold.has_value() || mean_within.has_value(); }
  std::size_t nonfinite_image = 0, nonfinite_reference = 0;  // pixels
  std::uint64_t other_alphas = 0;  // pixels; of metrics but bitwise that is said, and counts for nothing
  MeanRatios ratios;
  double luminance_ratio_error =
      0;  // standard error of ratios.luminance, from the scatter of the pixels, and what they share
  std::optional<ZTest> test;  // its map moved to error_map
  std::optional<WelchTest> welch;
  std::vector<WorstPixel> worst;  // greatest error first
  std::vector<double> error_map;  // one value a pixel, ≥ 0; NaN where not finite
};

// The images of `input` by a metric; its variances are needed by ztest alone. Without a threshold, ztest has
// ztest_tolerated, bitwise 0, welch its allowed distance, and the others pass. FLIP looks at a pixel's
// neighbours: where pixels are left out, `given_map` is that of the whole images without them (flip.h);
// empty: hdr_flip of the images given. For bitwise it is 1 at pixels that differ in more than their colours.
// `welch`: the test of that name, which is not made here.
Comparison compare(const ZTestInput& input, Metric metric, std::optional<double> threshold,
                   std::optional<double> mean_within = std::nullopt, std::vector<double> given_map = {},
                   std::optional<WelchTest> welch = std::nullopt);

// A few lines for people; one JSON object for programs (numbers that are not finite become null).
std::string to_text(const Comparison& comparison);
std::string to_json(const Comparison& comparison);

// The pixels of the greatest errors that are not 0, at most `count`. `error_map` has a value a pixel of the
// images, whose first pixel is at (x0, y0) of the whole picture.
std::vector<WorstPixel> worst_pixels(const std::vector<double>& error_map, const Image& image,
                                     const Image& reference, int x0, int y0, std::size_t count);

}  // namespace vitrail
