// SPDX-License-Identifier: Apache-2.0
#include "compare/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool finite_pixel(const Image& image, std::size_t p) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const float* v = &image.values[p * channels];
  return std::all_of(v, v + channels, [](float x) { return std::isfinite(x); });
}

}  // namespace

double squared_error(double a, double b) { return (a - b) * (a - b); }

double absolute_error(double a, double b) { return std::abs(a - b); }

double relative_squared_error(double a, double b) { return squared_error(a, b) / (b * b + 0.01); }

double symmetric_relative_error(double a, double b) {
  const double sum = std::abs(a) + std::abs(b);
  return sum == 0 ? 0 : 2 * std::abs(a - b) / sum;
}

void require_same_size(const Image& image, const Image& reference) {
  if (image.width != reference.width || image.height != reference.height)
    throw Error(fmt::format(
        "the images differ in size: {}×{} and {}×{} pixels; vitrail compare --resize compares them even so",
        image.width, image.height, reference.width, reference.height));
}

std::vector<double> error_map(const Image& image, const Image& reference,
                              const std::function<double(double, double)>& channel_error) {
  require_same_size(image, reference);
  std::vector<double> errors(image.pixels(), nan);
  for (std::size_t p = 0; p < errors.size(); ++p) {
    if (!finite_pixel(image, p) || !finite_pixel(reference, p)) continue;
    double sum = 0;
    for (std::size_t c = 3 * p; c < 3 * p + 3; ++c)
      sum += channel_error(static_cast<double>(image.values[c]), static_cast<double>(reference.values[c]));
    errors[p] = sum / 3;
  }
  return errors;
}

std::vector<double> difference_map(const Image& image, const Image& reference) {
  require_same_size(image, reference);
  std::vector<double> errors(image.pixels());
  for (std::size_t p = 0; p < errors.size(); ++p)
    errors[p] = std::memcmp(&image.values[3 * p], &reference.values[3 * p], 3 * sizeof(float)) == 0 ? 0 : 1;
  return errors;
}

double mean_of_valid(std::span<const double> values) {
  double sum = 0;
  std::size_t count = 0;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  return sum / static_cast<double>(count);
}

double psnr_of_mse(double mse) { return -10 * std::log10(mse); }

std::size_t count_nonfinite(const Image& image) {
  std::size_t count = 0;
  for (std::size_t p = 0; p < image.pixels(); ++p) count += finite_pixel(image, p) ? 0 : 1;
  return count;
}

MeanRatios mean_ratios(const Image& image, const Image& reference) {
  require_same_size(image, reference);
  RGB a, b;
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    if (!finite_pixel(image, p) || !finite_pixel(reference, p)) continue;
    const auto add = [p](RGB& sum, const Image& from) {
      sum.r += static_cast<double>(from.values[3 * p]);
      sum.g += static_cast<double>(from.values[3 * p + 1]);
      sum.b += static_cast<double>(from.values[3 * p + 2]);
    };
    add(a, image);
    add(b, reference);
  }
  const auto ratio = [](double x, double y) { return y == 0 ? nan : x / y; };
  const XYZ xyz_a = srgb_to_xyz(a), xyz_b = srgb_to_xyz(b);
  return {ratio(xyz_a.x, xyz_b.x), ratio(xyz_a.y, xyz_b.y), ratio(xyz_a.z, xyz_b.z),
          ratio(a.r, b.r),         ratio(a.g, b.g),         ratio(a.b, b.b)};
}

double luminance_ratio_error(const Image& image, const Image& reference, double neighbours_of_mean) {
  require_same_size(image, reference);
  const auto luminance = [](const Image& of, std::size_t p) {
    const float* v = &of.values[3 * p];
    return srgb_to_xyz({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}).y;
  };
  double sum = 0, squares = 0, reference_sum = 0, count = 0;
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    if (!finite_pixel(image, p) || !finite_pixel(reference, p)) continue;
    const double y = luminance(reference, p), difference = luminance(image, p) - y;
    sum += difference;
    squares += difference * difference;
    reference_sum += y;
    ++count;
  }
  const double variance = std::max(0.0, squares / count - (sum / count) * (sum / count));
  return reference_sum == 0 ? nan
                            : std::sqrt(neighbours_of_mean * variance / count) / (reference_sum / count);
}

}  // namespace vitrail
