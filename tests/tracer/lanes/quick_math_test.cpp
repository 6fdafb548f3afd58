// SPDX-License-Identifier: Apache-2.0
#include "tracer/simd/quick_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vitrail::quick_math_test {
namespace {

TEST(QuickMath, Exponential) {
  for (double x = -699; x < 700; x += 0.0371) EXPECT_NEAR(lanes::quick_exp(x) / std::exp(x), 1, 1e-11) << x;
  EXPECT_EQ(lanes::quick_exp(0.0), 1);
  EXPECT_EQ(lanes::quick_exp(-1e300), 0);
}

TEST(QuickMath, Logarithm) {
  for (double x = 1e-300; x < 1e300; x *= 1.37) EXPECT_NEAR(lanes::quick_log(x), std::log(x), 1e-10) << x;
  for (double x = 0.5; x < 2; x += 1e-3) EXPECT_NEAR(lanes::quick_log(x), std::log(x), 1e-10) << x;
  EXPECT_EQ(lanes::quick_log(1.0), 0);
}

TEST(QuickMath, ErrorFunction) {
  for (double x = 0; x < 7; x += 1e-3)
    EXPECT_NEAR(lanes::quick_erf(x, std::exp(-x * x)), std::erf(x), 1.6e-7) << x;
}

TEST(QuickMath, Circle) {
  for (double turn = 0; turn <= 1; turn += 1.0 / 1024) {
    const auto [c, s] = lanes::quick_circle(turn);
    EXPECT_NEAR(c, std::cos(2 * std::numbers::pi * turn), 1e-12) << turn;
    EXPECT_NEAR(s, std::sin(2 * std::numbers::pi * turn), 1e-12) << turn;
  }
}

}  // namespace
}  // namespace vitrail::quick_math_test
