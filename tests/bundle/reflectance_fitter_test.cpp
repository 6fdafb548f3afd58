// SPDX-License-Identifier: Apache-2.0
#include "bundle/reflectances/reflectance_fitter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>

#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::reflectance_fitter_test {

namespace {

double reflectance(const SigmoidNodes& x, double lambda) {
  const double t = (lambda - 595) / 235;
  const double v = t * (t - 1) / 2 * static_cast<double>(x[0]) + (1 - t * t) * static_cast<double>(x[1]) +
                   t * (t + 1) / 2 * static_cast<double>(x[2]);
  return 0.5 + v / (2 * std::sqrt(1 + v * v));
}

double difference(const ReflectanceFitter& fitter, RGB color) {
  const SigmoidNodes fast = fitter(color), slow = nodes_of(reflectance_from_rgb(color));
  double greatest = 0;
  for (double lambda = lambda_min_nm; lambda <= lambda_max_nm; lambda += 10)
    greatest = std::max(greatest, std::abs(reflectance(fast, lambda) - reflectance(slow, lambda)));
  return greatest;
}

TEST(ReflectanceFitter, AgreesWithTheFitOfOneColor) {
  const ReflectanceFitter fitter;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0, 1);
  double greatest = 0, sum = 0;
  constexpr int colors = 4000;
  for (int i = 0; i < colors; ++i) {
    const double power = i % 2 == 0 ? 1 : 4;  // half of the colours are dark and saturated
    const double d = difference(
        fitter, {std::pow(u(random), power), std::pow(u(random), power), std::pow(u(random), power)});
    greatest = std::max(greatest, d);
    sum += d;
  }
  EXPECT_LT(greatest, 2e-3);
  EXPECT_LT(sum / colors, 3e-5);
}

TEST(ReflectanceFitter, TakesEveryColor) {
  const ReflectanceFitter fitter;
  constexpr std::array edges{-1.0, 0.0, 1e-30, 1e-9, 1e-4, 0.5, 1 - 1e-9, 1.0, 7.0};
  for (const double r : edges)
    for (const double g : edges)
      for (const double b : edges)
        EXPECT_LT(difference(fitter, {r, g, b}), 2e-3) << r << ' ' << g << ' ' << b;
}

TEST(ReflectanceFitter, IsAFunctionOfTheColor) {
  const ReflectanceFitter first, second;
  std::vector<SigmoidNodes> a(2000), b(2000);
  const auto color = [](std::size_t i) {
    return RGB{static_cast<double>(i % 13) / 13, static_cast<double>(i % 47) / 47,
               static_cast<double>(i % 101) / 101};
  };
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = first(color(i));
  std::thread other([&] {
    for (std::size_t i = 0; i < b.size(); i += 2) b[i] = second(color(i));
  });
  for (std::size_t i = b.size(); i-- > 0;)
    if (i % 2 == 1) b[i] = second(color(i));
  other.join();
  EXPECT_EQ(a, b);
}

}  // namespace

}  // namespace vitrail::reflectance_fitter_test
