// SPDX-License-Identifier: Apache-2.0
// This file makes one comparison from end to end: the value of a metric, the verdict, the places of errors.
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

// Returns the metric of that name, or nothing for an unknown name.
std::optional<Metric> metric_of(const std::string& name);
const std::vector<std::string>& metric_names();

// A WorstPixel is a pixel of great error, with its colours in both images.
struct WorstPixel {
  int x = 0, y = 0;  // in the whole picture
  std::array<float, 3> image{}, reference{};
  double error = 0;  // of the metric
};

// A Comparison holds what one comparison found.
struct Comparison {
  Metric metric = Metric::relmse;
  // It is the metric's value: the fraction of values that fail for ztest, of pixels that differ for bitwise.
  // For welch it is the distance of its p-values from evenly spread ones.
  double value = 0;
  std::optional<double> threshold, mean_within;
  // It is true if value ≤ threshold, every pixel is finite in both images, and the means of X, Y and Z differ
  // by at most the fraction mean_within. Without that fraction ztest tests the means itself. Without a
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

// Compares the images of `input` by a metric; ztest alone needs their variances. Without a threshold, ztest
// takes ztest_tolerated, bitwise 0, welch its allowed distance, and the other metrics pass. FLIP looks at a
// pixel's neighbours. Where pixels are left out, `given_map` is therefore the map of the whole images without
// them (flip.h). If it is empty, hdr_flip of the images is taken. For bitwise, `given_map` is 1 at pixels
// that differ in more than their colours. `welch` is the Welch test of the pictures, which is not made here.
Comparison compare(const ZTestInput& input, Metric metric, std::optional<double> threshold,
                   std::optional<double> mean_within = std::nullopt, std::vector<double> given_map = {},
                   std::optional<WelchTest> welch = std::nullopt);

// They return a few lines for people, and one JSON object for programs (non-finite numbers become null).
std::string to_text(const Comparison& comparison);
std::string to_json(const Comparison& comparison);

// Returns the pixels of the greatest errors that are not 0, at most `count`. `error_map` has a value a pixel
// of the images, whose first pixel is at (x0, y0) of the whole picture.
std::vector<WorstPixel> worst_pixels(const std::vector<double>& error_map, const Image& image,
                                     const Image& reference, int x0, int y0, std::size_t count);

}  // namespace vitrail
