// SPDX-License-Identifier: Apache-2.0
#include "compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace vitrail {

const std::vector<std::string>& metric_names() {
  static const std::vector<std::string> names{"relmse", "mse", "mae", "psnr", "smape", "ztest", "bitwise"};
  return names;  // in the order of Metric
}

std::optional<Metric> metric_of(const std::string& name) {
  const auto at = std::find(metric_names().begin(), metric_names().end(), name);
  if (at == metric_names().end()) return std::nullopt;
  return static_cast<Metric>(at - metric_names().begin());
}

namespace {

const std::string& name_of(Metric metric) { return metric_names()[static_cast<std::size_t>(metric)]; }

// Fills in value and error map.
void measure(Comparison& c, const ZTestInput& input) {
  const auto mean_error = [&](double (*channel_error)(double, double)) {
    c.error_map = error_map(*input.image, *input.reference, channel_error);
    c.value = mean_of_valid(c.error_map);
  };
  switch (c.metric) {
    case Metric::relmse:
      return mean_error(relative_squared_error);
    case Metric::mse:
      return mean_error(squared_error);
    case Metric::mae:
      return mean_error(absolute_error);
    case Metric::smape:
      return mean_error(symmetric_relative_error);
    case Metric::psnr:
      mean_error(squared_error);
      c.value = psnr_of_mse(c.value);
      return;
    case Metric::bitwise:
      c.error_map = difference_map(*input.image, *input.reference);
      c.value = mean_of_valid(c.error_map);
      if (!c.threshold) c.threshold = 0;
      return;
    case Metric::ztest:
      ZTest test = ztest(input);
      c.error_map = std::move(test.z);
      c.value = static_cast<double>(test.failed) / static_cast<double>(test.values);
      if (!c.threshold) c.threshold = ztest_tolerated;
      return;
  }
}

bool means_agree(const Comparison& c) {
  const auto near_one = [&](double ratio) { return std::abs(ratio - 1) <= *c.mean_within; };
  return !c.mean_within || (near_one(c.ratios.x) && near_one(c.ratios.luminance) && near_one(c.ratios.z));
}

}  // namespace

Comparison compare(const ZTestInput& input, Metric metric, std::optional<double> threshold,
                   std::optional<double> mean_within) {
  Comparison c;
  c.metric = metric;
  c.threshold = threshold;
  c.mean_within = mean_within;
  c.nonfinite_image = count_nonfinite(*input.image);
  c.nonfinite_reference = count_nonfinite(*input.reference);
  c.ratios = mean_ratios(*input.image, *input.reference);
  measure(c, input);
  const bool within = !c.threshold || c.value <= *c.threshold;
  c.passed = within && means_agree(c) && c.nonfinite_image == 0 && c.nonfinite_reference == 0;
  return c;
}

std::string to_text(const Comparison& c) {
  std::string text = fmt::format("{} {:.9g}", name_of(c.metric), c.value);
  if (c.threshold) text += fmt::format(" (at most {:.9g})", *c.threshold);
  text +=
      fmt::format("\nmean ratio: X {:.6f}, luminance {:.6f}, Z {:.6f}, red {:.6f}, green {:.6f}, blue {:.6f}",
                  c.ratios.x, c.ratios.luminance, c.ratios.z, c.ratios.red, c.ratios.green, c.ratios.blue);
  if (c.mean_within) text += fmt::format(" (X, Y, Z within {:.9g})", *c.mean_within);
  text += '\n';
  if (c.nonfinite_image + c.nonfinite_reference > 0)
    text += fmt::format("pixels that are not finite: {} of the image, {} of the reference\n",
                        c.nonfinite_image, c.nonfinite_reference);
  return text + (c.passed ? "passed\n" : "failed\n");
}

std::string to_json(const Comparison& c) {
  nlohmann::ordered_json json{{"metric", name_of(c.metric)},
                              {"value", c.value},
                              {"threshold", nullptr},
                              {"passed", c.passed},
                              {"pixels", c.error_map.size()},
                              {"nonfinite_image", c.nonfinite_image},
                              {"nonfinite_reference", c.nonfinite_reference},
                              {"mean_ratio_x", c.ratios.x},
                              {"mean_ratio_y", c.ratios.luminance},
                              {"mean_ratio_z", c.ratios.z},
                              {"mean_within", nullptr},
                              {"luminance_ratio", c.ratios.luminance},
                              {"red_ratio", c.ratios.red},
                              {"green_ratio", c.ratios.green},
                              {"blue_ratio", c.ratios.blue}};
  if (c.threshold) json["threshold"] = *c.threshold;
  if (c.mean_within) json["mean_within"] = *c.mean_within;
  return json.dump() + "\n";
}

Image heatmap(const Comparison& c, int width, int height) {
  std::vector<double> sorted;
  for (const double e : c.error_map)
    if (!std::isnan(e)) sorted.push_back(e);
  double hottest = 0;
  if (!sorted.empty()) {
    const auto percentile = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 99 / 100);
    std::nth_element(sorted.begin(), percentile, sorted.end());
    hottest = *percentile > 0 ? *percentile : *std::max_element(sorted.begin(), sorted.end());
  }
  Image image = black_image(width, height, 3);
  for (std::size_t p = 0; p < c.error_map.size(); ++p) {
    const double e = c.error_map[p];
    const auto heat = static_cast<float>(hottest > 0 ? 3 * std::min(1.0, e / hottest) : 0);
    for (std::size_t k = 0; k < 3; ++k)
      image.values[3 * p + k] =
          std::isnan(e) ? (k == 1 ? 0.f : 1.f) : std::clamp(heat - static_cast<float>(k), 0.f, 1.f);
  }
  return image;
}

}  // namespace vitrail
