// SPDX-License-Identifier: Apache-2.0
#include "compare/comparison.h"

#include <algorithm>
#include <cmath>

#include "compare/flip.h"
#include "compare/ssim.h"

namespace vitrail {

const std::vector<std::string>& metric_names() {
  static const std::vector<std::string> names{"relmse", "mse",   "rmse",    "mae",  "psnr", "smape",
                                              "flip",   "ztest", "bitwise", "ssim", "welch"};
  return names;  // in the order of Metric
}

std::optional<Metric> metric_of(const std::string& name) {
  const auto at = std::find(metric_names().begin(), metric_names().end(), name);
  if (at == metric_names().end()) return std::nullopt;
  return static_cast<Metric>(at - metric_names().begin());
}

namespace {

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
    case Metric::rmse:
      mean_error(squared_error);
      c.value = std::sqrt(c.value);
      return;
    case Metric::mae:
      return mean_error(absolute_error);
    case Metric::smape:
      return mean_error(symmetric_relative_error);
    case Metric::flip:
      if (c.error_map.empty()) c.error_map = hdr_flip(*input.image, *input.reference);
      c.value = mean_of_valid(c.error_map);
      return;
    case Metric::psnr:
      mean_error(squared_error);
      c.value = psnr_of_mse(c.value);
      return;
    case Metric::bitwise: {
      const std::vector<double> beside = std::move(c.error_map);
      c.error_map = difference_map(*input.image, *input.reference);
      for (std::size_t p = 0; p < beside.size(); ++p) c.error_map[p] = std::max(c.error_map[p], beside[p]);
      c.value = mean_of_valid(c.error_map);
      if (!c.threshold) c.threshold = 0;
      return;
    }
    case Metric::ssim:
      c.error_map = ssim_map(*input.image, *input.reference);
      c.value = mean_of_valid(c.error_map);
      for (double& v : c.error_map) v = v > 1 ? 0 : 1 - v;
      return;
    case Metric::welch:
      c.error_map = welch_map(*c.welch, input.image->width, input.image->height);
      c.value = c.welch->distance;
      if (!c.threshold) c.threshold = c.welch->allowed_distance;
      return;
    case Metric::ztest:
      c.test = ztest(input);
      c.error_map = std::move(c.test->z);
      c.value = static_cast<double>(c.test->failed) / static_cast<double>(c.test->values);
      if (!c.threshold) c.threshold = ztest_tolerated;
      return;
  }
}

bool means_agree(const Comparison& c) {
  const auto near_one = [&](double ratio) { return std::abs(ratio - 1) <= *c.mean_within; };
  if (!c.mean_within) return !c.test || !c.test->means_differ;
  return (near_one(c.ratios.x) && near_one(c.ratios.luminance) && near_one(c.ratios.z));
}

}  // namespace

Comparison compare(const ZTestInput& input, Metric metric, std::optional<double> threshold,
                   std::optional<double> mean_within, std::vector<double> given_map,
                   std::optional<WelchTest> welch) {
  Comparison c;
  c.error_map = std::move(given_map);
  c.welch = std::move(welch);
  c.metric = metric;
  c.threshold = threshold;
  c.mean_within = mean_within;
  c.nonfinite_image = count_nonfinite(*input.image);
  c.nonfinite_reference = count_nonfinite(*input.reference);
  c.ratios = mean_ratios(*input.image, *input.reference);
  c.luminance_ratio_error =
      std::max(luminance_ratio_error(*input.image, *input.reference, input.neighbours_of_mean),
               c.ratios.luminance * input.shared_error);
  measure(c, input);
  const bool within = !c.threshold || c.value <= *c.threshold;
  c.passed = within && means_agree(c) && c.nonfinite_image == 0 && c.nonfinite_reference == 0;
  return c;
}

std::vector<WorstPixel> worst_pixels(const std::vector<double>& error_map, const Image& image,
                                     const Image& reference, int x0, int y0, std::size_t count) {
  std::vector<std::size_t> order;
  for (std::size_t p = 0; p < error_map.size(); ++p)
    if (!(error_map[p] == 0)) order.push_back(p);
  // What is not a number is the worst.
  const auto worse = [&](std::size_t a, std::size_t b) {
    const double x = std::isnan(error_map[a]) ? HUGE_VAL : error_map[a],
                 y = std::isnan(error_map[b]) ? HUGE_VAL : error_map[b];
    return x != y ? x > y : a < b;
  };
  count = std::min(count, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(), worse);
  std::vector<WorstPixel> worst;
  const auto width = static_cast<std::size_t>(image.width);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t p = order[i];
    WorstPixel& w = worst.emplace_back();
    w.x = x0 + static_cast<int>(p % width), w.y = y0 + static_cast<int>(p / width);
    for (std::size_t c = 0; c < 3; ++c)
      w.image[c] = image.values[3 * p + c], w.reference[c] = reference.values[3 * p + c];
    w.error = error_map[p];
  }
  return worst;
}

}  // namespace vitrail
