// SPDX-License-Identifier: Apache-2.0
// The pairs that Sharma, Wu and Dalal (2005, table 1) publish to find errors of implementations.
#include "compare/color_difference.h"

#include <gtest/gtest.h>

namespace vitrail::color_difference_test {
namespace {

struct Pair {
  CieLab first, second;
  double expected;
};

TEST(Ciede2000, IsThePublishedOne) {
  const Pair pairs[] = {{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
                        {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
                        {{50, 0, 0}, {50, -1, 2}, 2.3669},
                        {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
                        {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
                        {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
                        {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
                        {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
                        {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}};
  for (const Pair& p : pairs) {
    EXPECT_NEAR(ciede2000(p.first, p.second), p.expected, 5e-5);
    EXPECT_NEAR(ciede2000(p.second, p.first), p.expected, 5e-5);
  }
}

TEST(Ciede2000, OfPicturesIsAsTheScreenShowsThem) {
  const Image white{1, 1, 3, {2, 2, 2}}, brighter{1, 1, 3, {9, 9, 9}}, black = black_image(1, 1, 3);
  EXPECT_EQ(ciede2000_map(white, brighter, 2).at(0), 0);
  EXPECT_NEAR(ciede2000_map(white, black, 2).at(0), 100, 1e-6);
  EXPECT_NEAR(bright_luminance(white), 2, 1e-6);
}

}  // namespace
}  // namespace vitrail::color_difference_test
