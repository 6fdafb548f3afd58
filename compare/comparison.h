// SPDX-License-Identifier: Apache-2.0
// One comparison from end to end: the value of a metric, the verdict, and where the errors are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/metrics.h"
#include "compare/ztest.h"

namespace vitrail {

enum class Metric { relmse, mse, mae, psnr, smape, ztest, bitwise };

// Empty for an unknown name.
std::optional<Metric> metric_of(const std::string& name);
const std::vector<std::string>& metric_names();

struct Comparison {
  Metric metric = Metric::relmse;
  double value = 0;  // for ztest the fraction of values that fail, for bitwise of pixels that differ
  std::optional<double> threshold, mean_within;
  // value ≤ threshold, the means of X, Y and Z differ by no more than the fraction mean_within, and every
  // pixel is finite in both images.
  bool passed = true;
  std::size_t nonfinite_image = 0, nonfinite_reference = 0;  // pixels
  MeanRatios ratios;
  std::vector<double> error_map;  // one value a pixel, ≥ 0; NaN where not finite
};

// The images of `input` by a metric; its variances are needed by ztest alone. Without a threshold, ztest has
// ztest_tolerated, bitwise 0, and the others pass.
Comparison compare(const ZTestInput& input, Metric metric, std::optional<double> threshold,
                   std::optional<double> mean_within = std::nullopt);

// A few lines for people; one flat JSON object for programs (numbers that are not finite become null).
std::string to_text(const Comparison& comparison);
std::string to_json(const Comparison& comparison);

// The error map as colours, black – red – yellow – white, linear from 0 to its 99th percentile; magenta where
// NaN.
Image heatmap(const Comparison& comparison, int width, int height);

}  // namespace vitrail
