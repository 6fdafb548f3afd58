// SPDX-License-Identifier: Apache-2.0
#include "compare/comparison_page.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/comparison.h"
#include "compare/comparison_html.h"
#include "compare/error_images.h"
#include "compare/flip.h"
#include "compare/web_page.h"

namespace vitrail {

namespace {

using Json = nlohmann::ordered_json;

// Half floats in units of a power of two that puts the greatest of the values near the top of their range:
// values of any size keep their 11 bits, down to 2^−28 of the greatest.
template <typename Values>
Json halves(const Values& values) {
  double greatest = 0;
  for (const double v : values)
    if (std::isfinite(v)) greatest = std::max(greatest, std::abs(v));
  constexpr int top = 14;  // a half float is less than 2^16
  const double unit = greatest > 0 ? std::ldexp(1.0, std::max(std::ilogb(greatest) - top, -1022)) : 1;
  std::vector<float> scaled;
  scaled.reserve(values.size());
  for (const double v : values) scaled.push_back(static_cast<float>(v / unit));
  return {{"unit", unit}, {"halves", half_floats_base64(scaled)}};
}

Json error_of(const char* name, const char* about, double value, const std::vector<double>& map,
              double scale) {
  return {{"name", name}, {"about", about}, {"value", value}, {"scale", scale}, {"map", halves(map)}};
}

Json errors(const ComparisonPage& page) {
  const Image &a = *page.image, &b = *page.reference;
  const std::vector<double> flip =
      page.low_range ? ldr_flip(a, b, page.pixels_per_degree) : hdr_flip(a, b, page.pixels_per_degree);
  Json all = Json::array();
  all.push_back(error_of("flip", "the difference that a viewer notices when flipping between the two, 0 to 1",
                         mean_of_valid(flip), flip, 1));
  const auto add = [&](const char* name, const char* about, double (*channel_error)(double, double)) {
    const std::vector<double> map = error_map(a, b, channel_error);
    all.push_back(error_of(name, about, mean_of_valid(map), map, hottest(map)));
  };
  add("relmse", "(a − b)² / (b² + 0.01)", relative_squared_error);
  add("mae", "|a − b|", absolute_error);
  add("mse", "(a − b)²", squared_error);
  add("smape", "2 |a − b| / (|a| + |b|)", symmetric_relative_error);
  return all;
}

Json rows(const ComparisonPage& page, const Json& all) {
  const Image &a = *page.image, &b = *page.reference;
  const MeanRatios ratios = mean_ratios(a, b);
  const double mse = mean_of_valid(error_map(a, b, squared_error));
  Json table = Json::array();
  for (const Json& error : all) table.push_back({error["name"], error["value"], error["about"]});
  table.push_back({"rmse", std::sqrt(mse), "√mse"});
  table.push_back({"psnr", psnr_of_mse(mse), "dB, for a peak of 1"});
  table.push_back({"bitwise", mean_of_valid(difference_map(a, b)), "pixels with any bit different"});
  table.push_back({"luminance", ratios.luminance, "mean of the image over that of the reference"});
  table.push_back({"± (95 %)", 1.96 * luminance_ratio_error(a, b, page.neighbours_of_mean),
                   page.neighbours_of_mean > 1 ? "with the correlation that splatting makes"
                                               : "if the pixels' errors are independent"});
  table.push_back({"red", ratios.red, "as luminance"});
  table.push_back({"green", ratios.green, ""});
  table.push_back({"blue", ratios.blue, ""});
  table.push_back({"not finite", count_nonfinite(a) + count_nonfinite(b), "pixels, left out of the rest"});
  return table;
}

}  // namespace

std::string comparison_page(const ComparisonPage& page) {
  const Json all = errors(page);
  const Json data{{"names", {page.image_name, page.reference_name}},
                  {"width", page.image->width},
                  {"height", page.image->height},
                  {"x0", page.x0},
                  {"y0", page.y0},
                  {"ppd", page.pixels_per_degree},
                  {"flip", page.low_range ? "of images for screens" : "of images of any range"},
                  {"images", {halves(page.image->values), halves(page.reference->values)}},
                  {"errors", all},
                  {"rows", rows(page, all)}};
  // A name of a file may be no UTF-8.
  return page_with_data(comparison_html, data.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace vitrail
