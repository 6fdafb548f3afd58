// SPDX-License-Identifier: Apache-2.0
#include "compare/ztest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "compare/metrics.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

// X, Y and Z of a pixel, or Y first where it alone is tested.
std::array<double, 3> tested_values(const Image& image, std::size_t p, std::size_t channels) {
  const float* v = &image.values[3 * p];
  const XYZ c =
      srgb_to_xyz({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])});
  if (channels == 1) return {c.y, 0, 0};
  return {c.x, c.y, c.z};
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

namespace {

// Sums over the pixels that are finite in both, of one of X, Y and Z.
struct MeanSums {
  double difference = 0, variance = 0, reference = 0, squares = 0;
  double sigmas() const {
    const double beyond = std::max(0.0, std::abs(difference) - 0x1p-11 * reference);
    return beyond == 0 ? 0 : beyond / std::sqrt(variance);
  }
};

void judge_means(ZTest& result, std::span<const MeanSums> sums, std::size_t pixels) {
  for (const MeanSums& s : sums) result.mean_sigmas = std::max(result.mean_sigmas, s.sigmas());
  const double channels = static_cast<double>(sums.size());
  result.means_differ =
      two_sided_p(result.mean_sigmas, 0) < -std::expm1(std::log1p(-ztest_mean_significance) / channels);
  const MeanSums& luminance = sums[sums.size() == 1 ? 0 : 1];
  result.difference_rms = std::sqrt(luminance.squares / static_cast<double>(pixels));
}

}  // namespace

ZTest ztest(const ZTestInput& input) {
  require_same_size(*input.image, *input.reference);
  const std::size_t pixels = input.image->pixels();
  const std::size_t channels = input.variance.size() / pixels;
  ZTest result;
  result.z.resize(pixels);
  result.values = channels * pixels;
  // 1 − (1 − α)^(1/N)
  result.value_significance = -std::expm1(std::log1p(-ztest_significance) / static_cast<double>(pixels));
  std::array<MeanSums, 3> sums;
  for (std::size_t p = 0; p < pixels; ++p) {
    const std::array<double, 3> a = tested_values(*input.image, p, channels),
                                b = tested_values(*input.reference, p, channels);
    const int freedom = input.degrees_of_freedom.empty() ? 0 : input.degrees_of_freedom[p];
    for (std::size_t c = 0; c < channels; ++c) {
      const double difference = a[c] - b[c], variance = input.variance[channels * p + c];
      const double z = difference == 0 ? 0 : std::abs(difference) / std::sqrt(variance);
      if (!(z <= result.z[p])) result.z[p] = z;
      if (!(two_sided_p(z, freedom) > result.value_significance)) ++result.failed;
      if (!std::isfinite(difference)) continue;
      sums[c].difference += difference;
      sums[c].squares += difference * difference;
      sums[c].variance += variance;
      sums[c].reference += std::abs(b[c]);
    }
  }
  result.noise_rms = std::sqrt(sums[channels == 1 ? 0 : 1].variance / static_cast<double>(pixels));
  for (MeanSums& s : sums)
    s.variance = std::max(input.neighbours_of_mean * s.variance,
                          input.shared_error * input.shared_error * s.reference * s.reference);
  judge_means(result, std::span(sums).first(channels), pixels);
  return result;
}

}  // namespace vitrail
