// SPDX-License-Identifier: Apache-2.0
#include "compare/variance.h"

#include <algorithm>
#include <cmath>

#include "scene/color.h"

namespace vitrail {

namespace {

constexpr double least_mitsuba_variance = 1e-4;

XYZ xyz_at(const Image& image, std::size_t p) {
  const float* v = &image.values[3 * p];
  return srgb_to_xyz({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])});
}

}  // namespace

std::vector<double> luminance_variance(const Image& variance) {
  return {variance.values.begin(), variance.values.end()};
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
