// SPDX-License-Identifier: Apache-2.0
#include "compare/ztest.h"

#include <cmath>
#include <numbers>

#include "compare/metrics.h"
#include "scene/color.h"

namespace vitrail {

namespace {

double luminance_at(const Image& image, std::size_t p) {
  const float* v = &image.values[3 * p];
  return srgb_to_xyz({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}).y;
}

}  // namespace

double two_sided_p(double t, int degrees_of_freedom) {
  if (degrees_of_freedom == 0) return std::erfc(std::abs(t) / std::numbers::sqrt2);
  const double theta = std::atan(std::abs(t) / std::sqrt(degrees_of_freedom));
  const double cosine = std::cos(theta);
  const bool odd = degrees_of_freedom % 2 == 1;
  double term = odd ? cosine : 1, sum = 0;
  for (int k = odd ? 1 : 0; k < degrees_of_freedom - 1; k += 2) {
    sum += term;
    term *= cosine * cosine * (k + 1) / (k + 2);
  }
  const double inside = std::sin(theta) * sum;
  return 1 - (odd ? 2 / std::numbers::pi * (theta + inside) : inside);
}

std::vector<double> luminance_variance(const Image& variance) {
  const RGB weight{srgb_to_xyz({1, 0, 0}).y, srgb_to_xyz({0, 1, 0}).y, srgb_to_xyz({0, 0, 1}).y};
  std::vector<double> result(variance.pixels());
  for (std::size_t p = 0; p < result.size(); ++p) {
    if (variance.channels == 1) {
      result[p] = static_cast<double>(variance.values[p]);
      continue;
    }
    const float* v = &variance.values[3 * p];
    const auto sigma = [v](int c) { return std::sqrt(static_cast<double>(v[c])); };
    const double s = weight.r * sigma(0) + weight.g * sigma(1) + weight.b * sigma(2);
    result[p] = s * s;
  }
  return result;
}

ZTest ztest(const ZTestInput& input) {
  require_same_size(*input.image, *input.reference);
  const std::size_t pixels = input.image->pixels();
  ZTest result;
  result.z.resize(pixels);
  // 1 − (1 − α)^(1/N)
  result.pixel_significance = -std::expm1(std::log1p(-ztest_significance) / static_cast<double>(pixels));
  for (std::size_t p = 0; p < pixels; ++p) {
    const double y = luminance_at(*input.reference, p);
    const double rounding = std::abs(y) * 0x1p-11 + 0x1p-24;
    const double sigma = std::sqrt(input.variance[p] + rounding * rounding);
    result.z[p] = std::abs(luminance_at(*input.image, p) - y) / sigma;
    if (!(two_sided_p(result.z[p], input.degrees_of_freedom) > result.pixel_significance)) ++result.failed;
  }
  return result;
}

}  // namespace vitrail
