// SPDX-License-Identifier: Apache-2.0
#include "compare/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/metrics.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

constexpr int radius = 5;

std::array<double, radius + 1> gaussian() {
  constexpr double sigma = 1.5;
  std::array<double, radius + 1> weights{};
  for (int i = 0; i <= radius; ++i)
    weights[static_cast<std::size_t>(i)] = std::exp(-0.5 * i * i / (sigma * sigma));
  return weights;
}

// Along an axis of `count` positions, `stride` apart, of `lines` that begin `line_stride` apart.
void blur_along(std::vector<double>& values, std::size_t count, std::size_t stride, std::size_t lines,
                std::size_t line_stride) {
  static const std::array<double, radius + 1> weights = gaussian();
  std::vector<double> line(count);
  for (std::size_t l = 0; l < lines; ++l) {
    double* const at = &values[l * line_stride];
    for (std::size_t i = 0; i < count; ++i) line[i] = at[i * stride];
    for (std::size_t i = 0; i < count; ++i) {
      double sum = 0, weight = 0;
      for (std::size_t j = i - std::min<std::size_t>(i, radius); j < std::min(count, i + radius + 1); ++j) {
        const double w = weights[i < j ? j - i : i - j];
        sum += w * line[j];
        weight += w;
      }
      at[i * stride] = sum / weight;
    }
  }
}

// The weighted mean about each pixel.
std::vector<double> blurred(std::vector<double> values, const Image& extent) {
  const auto width = static_cast<std::size_t>(extent.width), height = static_cast<std::size_t>(extent.height);
  blur_along(values, width, 1, height, width);
  blur_along(values, height, width, width, 1);
  return values;
}

std::vector<double> shown_luminance(const Image& image) {
  std::vector<double> values(image.pixels());
  for (std::size_t p = 0; p < values.size(); ++p) {
    const float* c = &image.values[3 * p];
    const double y =
        srgb_to_xyz({static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])}).y;
    values[p] = std::isfinite(y) ? srgb_encode(std::clamp(y, 0.0, 1.0)) : std::nan("");
  }
  return values;
}

std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> values(a.size());
  std::ranges::transform(a, b, values.begin(), [](double x, double y) { return x * y; });
  return values;
}

}  // namespace

std::vector<double> ssim_map(const Image& image, const Image& reference) {
  require_same_size(image, reference);
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  const std::vector<double> a = shown_luminance(image), b = shown_luminance(reference);
  const std::vector<double> mean_a = blurred(a, image), mean_b = blurred(b, image),
                            aa = blurred(product(a, a), image), bb = blurred(product(b, b), image),
                            ab = blurred(product(a, b), image);
  std::vector<double> map(a.size());
  for (std::size_t p = 0; p < map.size(); ++p) {
    const double ma = mean_a[p], mb = mean_b[p];
    const double variances = aa[p] - ma * ma + bb[p] - mb * mb, covariance = ab[p] - ma * mb;
    map[p] = (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (variances + c2));
  }
  return map;
}

}  // namespace vitrail
