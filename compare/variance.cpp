// SPDX-License-Identifier: Apache-2.0
#include "compare/variance.h"

#include <algorithm>
#include <cmath>

#include "scene/records/pixel_place.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

constexpr double least_mitsuba_variance = 1e-4;

constexpr int reach = 3;  // of a neighbourhood, pixels to each side

// Of estimates s² with ν degrees of freedom each. E[s⁴/(ν + 2)] = σ⁴/ν, which is what Satterthwaite's formula
// asks for; where neighbours are alike the variance of the sum is so many times as much.
struct Sums {
  double sum = 0, of_squares = 0, count = 0, freedom = 0;
  void add(double estimate, const EstimatedVariance& part) {
    sum += estimate;
    of_squares += part.neighbours_of_variances * estimate * estimate / (part.degrees_of_freedom + 2);
    freedom += part.degrees_of_freedom / part.neighbours_of_variances;
    ++count;
  }
  int degrees_of_freedom() const {
    const double effective = of_squares > 0 ? sum * sum / of_squares : freedom;
    return std::max(1, static_cast<int>(std::min(effective, freedom)));
  }
};

XYZ xyz_at(const Image& image, std::size_t p) {
  const float* v = &image.values[3 * p];
  return srgb_to_xyz({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])});
}

}  // namespace

PooledVariance pooled(std::span<const EstimatedVariance> parts) {
  const int width = parts[0].variance->width, height = parts[0].variance->height;
  PooledVariance result;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Sums around, own;
      for (const EstimatedVariance& part : parts) {
        const auto estimate = [&](int column, int row) {
          return static_cast<double>(part.variance->values[pixel_place(column, row, width)]);
        };
        for (int row = std::max(y - reach, 0); row <= std::min(y + reach, height - 1); ++row)
          for (int column = std::max(x - reach, 0); column <= std::min(x + reach, width - 1); ++column)
            around.add(estimate(column, row), part);
        own.add(estimate(x, y), part);
      }
      const double mean = around.sum * static_cast<double>(parts.size()) / around.count;
      result.variance.push_back(std::max(mean, own.sum));
      result.degrees_of_freedom.push_back(around.degrees_of_freedom());
    }
  return result;
}

std::vector<double> mitsuba_variance(const Image& rgb, double samples) {
  std::vector<double> result;
  result.reserve(3 * rgb.pixels());
  for (std::size_t p = 0; p < rgb.pixels(); ++p) {
    const XYZ v = xyz_at(rgb, p);
    for (const double of_sample : {v.x, v.y, v.z})
      result.push_back(std::max(of_sample, least_mitsuba_variance) / samples);
  }
  return result;
}

std::size_t widen(std::vector<double>& variance, const std::vector<double>& own) {
  std::size_t widened = 0;
  for (std::size_t p = 0; p < own.size(); ++p) {
    const double factor = own[p] / variance[3 * p + 1];
    if (!(factor > 1)) continue;
    for (std::size_t c = 0; c < 3; ++c) variance[3 * p + c] *= factor;
    ++widened;
  }
  return widened;
}

void add_rounding(std::vector<double>& variance, const Image& reference) {
  for (std::size_t p = 0; p < variance.size(); ++p) {
    const double rounding = std::abs(xyz_at(reference, p).y) * 0x1p-11 + 0x1p-24;
    variance[p] += rounding * rounding;
  }
}

}  // namespace vitrail
