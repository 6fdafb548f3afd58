// SPDX-License-Identifier: Apache-2.0
// A comparison for people and for programs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/comparison.h"

namespace vitrail {

namespace {

const std::string& name_of(Metric metric) { return metric_names()[static_cast<std::size_t>(metric)]; }

constexpr double two_sided_95 = 1.96;  // standard errors

std::string about_noise(const ZTest& t) {
  const double bias =
      std::sqrt(std::max(0.0, t.difference_rms * t.difference_rms - t.noise_rms * t.noise_rms));
  return fmt::format("luminance differs by {:.4g} rms: {:.4g} is noise, {:.4g} is not\n", t.difference_rms,
                     t.noise_rms, bias);
}

std::string about_tiles(const WelchTest& t) {
  return fmt::format(
      "p-values of {} tiles of {} × {} pixels, by tenths: {}; evenly spread where nothing differs\n",
      t.tested, welch_tile, welch_tile, fmt::join(t.histogram, " "));
}

}  // namespace

std::string to_text(const Comparison& c) {
  std::string text = fmt::format("{} {:.9g}", name_of(c.metric), c.value);
  if (c.threshold) text += fmt::format(" (at most {:.9g})", *c.threshold);
  text +=
      fmt::format("\nmean ratio: X {:.6f}, luminance {:.6f}, Z {:.6f}, red {:.6f}, green {:.6f}, blue {:.6f}",
                  c.ratios.x, c.ratios.luminance, c.ratios.z, c.ratios.red, c.ratios.green, c.ratios.blue);
  if (c.mean_within) text += fmt::format(" (X, Y, Z within {:.9g})", *c.mean_within);
  text += fmt::format("\nluminance is off by {:+.3g} % ± {:.2g} % (95 %)\n", 100 * (c.ratios.luminance - 1),
                      100 * two_sided_95 * c.luminance_ratio_error);
  if (c.test) {
    text += about_noise(*c.test);
    text += fmt::format("the means differ by {:.3g} standard errors{}\n", c.test->mean_sigmas,
                        c.mean_within          ? ""
                        : c.test->means_differ ? ": too many"
                                               : "");
  }
  if (c.welch) text += about_tiles(*c.welch);
  if (c.nonfinite_image + c.nonfinite_reference > 0)
    text += fmt::format("pixels that are not finite: {} of the image, {} of the reference\n",
                        c.nonfinite_image, c.nonfinite_reference);
  if (c.other_alphas > 0)
    text += fmt::format("alpha differs in {} pixel{}{}\n", c.other_alphas, c.other_alphas == 1 ? "" : "s",
                        c.metric == Metric::bitwise ? "" : ", which this metric does not look at");
  for (const WorstPixel& w : c.worst)
    text +=
        fmt::format("pixel {},{}: {:.4g} {:.4g} {:.4g}, in the reference {:.4g} {:.4g} {:.4g}\n", w.x, w.y,
                    w.image[0], w.image[1], w.image[2], w.reference[0], w.reference[1], w.reference[2]);
  if (!c.passed) return text + "failed\n";
  return text + (c.judged() ? "passed\n" : "");
}

std::string to_json(const Comparison& c) {
  using Json = nlohmann::ordered_json;
  Json json{{"metric", name_of(c.metric)},
            {"value", c.value},
            {"threshold", nullptr},
            {"passed", nullptr},
            {"pixels", c.error_map.size()},
            {"nonfinite_image", c.nonfinite_image},
            {"nonfinite_reference", c.nonfinite_reference},
            {"alpha_differs", c.other_alphas},
            {"mean_ratio_x", c.ratios.x},
            {"mean_ratio_y", c.ratios.luminance},
            {"mean_ratio_z", c.ratios.z},
            {"mean_within", nullptr},
            {"luminance_ratio", c.ratios.luminance},
            {"luminance_ratio_error", c.luminance_ratio_error},
            {"red_ratio", c.ratios.red},
            {"green_ratio", c.ratios.green},
            {"blue_ratio", c.ratios.blue}};
  if (c.threshold) json["threshold"] = *c.threshold;
  if (c.mean_within) json["mean_within"] = *c.mean_within;
  if (c.judged() || !c.passed) json["passed"] = c.passed;
  if (c.test) {
    json["mean_sigmas"] = c.test->mean_sigmas;
    json["noise_rms"] = c.test->noise_rms;
    json["difference_rms"] = c.test->difference_rms;
  }
  if (c.welch) {
    json["tiles"] = c.welch->tested;
    json["histogram"] = c.welch->histogram;
  }
  for (const WorstPixel& w : c.worst)
    json["worst"].push_back(
        {{"x", w.x}, {"y", w.y}, {"image", w.image}, {"reference", w.reference}, {"error", w.error}});
  return json.dump() + "\n";
}

}  // namespace vitrail
