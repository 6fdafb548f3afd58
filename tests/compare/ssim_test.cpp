// SPDX-License-Identifier: Apache-2.0
#include "compare/ssim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/spectra/color.h"

namespace vitrail::ssim_test {
namespace {

constexpr int side = 24;

// Greys whose encoded values are `shown`(x, y).
template <class Shown>
Image greys(const Shown& shown) {
  Image image{side, side, 3, {}};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      image.values.insert(image.values.end(), 3, static_cast<float>(srgb_decode(shown(x, y))));
  return image;
}

double wave(int x, int y) { return 0.5 + 0.2 * std::sin(0.9 * x) * std::cos(0.7 * y); }
double other(int x, int y) { return 0.45 + 0.15 * std::sin(0.9 * x + 0.4) + 0.01 * (y % 3); }

// The definition, term by term, in a pixel away from the border.
double ssim_at(int x, int y) {
  double weight = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (int j = y - 5; j <= y + 5; ++j)
    for (int i = x - 5; i <= x + 5; ++i) {
      const double w = std::exp(-((i - x) * (i - x) + (j - y) * (j - y)) / (2 * 1.5 * 1.5));
      const double va = wave(i, j), vb = other(i, j);
      weight += w, a += w * va, b += w * vb;
      aa += w * va * va, bb += w * vb * vb, ab += w * va * vb;
    }
  a /= weight, b /= weight;
  const double sa = aa / weight - a * a, sb = bb / weight - b * b, sab = ab / weight - a * b;
  return (2 * a * b + 1e-4) * (2 * sab + 9e-4) / ((a * a + b * b + 1e-4) * (sa + sb + 9e-4));
}

TEST(Ssim, IsTheDefinition) {
  const std::vector<double> map = ssim_map(greys(wave), greys(other));
  for (const auto& [x, y] : {std::pair(5, 5), {12, 9}, {18, 18}})
    EXPECT_NEAR(map[static_cast<std::size_t>(y * side + x)], ssim_at(x, y), 1e-5);
}

TEST(Ssim, IsOneForEqualImagesAndFallsWithContrastAndStructure) {
  const auto at_middle = [](const auto& a, const auto& b) {
    return ssim_map(greys(a), greys(b))[side * side / 2 + side / 2];
  };
  for (const double s : ssim_map(greys(wave), greys(wave))) EXPECT_NEAR(s, 1, 1e-12);
  const auto flat = [](double v) { return [v](int, int) { return v; }; };
  EXPECT_NEAR(at_middle(flat(0.2), flat(0.6)), (2 * 0.2 * 0.6 + 1e-4) / (0.04 + 0.36 + 1e-4), 1e-5);
  EXPECT_LT(at_middle(wave, [](int x, int y) { return 1 - wave(x, y); }), -0.5);
}

TEST(Ssim, KnowsNothingAboutPixelsThatAreNotFinite) {
  Image broken = greys(wave);
  broken.values[0] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<double> map = ssim_map(broken, greys(wave));
  EXPECT_TRUE(std::isnan(map[0]) && std::isnan(map[5]) && std::isnan(map[5 * side]));
  EXPECT_FALSE(std::isnan(map[6]) || std::isnan(map[6 * side]));
}

}  // namespace
}  // namespace vitrail::ssim_test
