// SPDX-License-Identifier: Apache-2.0
#include "film/tone_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace vitrail::tone_map_test {
namespace {

std::array<double, 3> shown(float r, float g, float b) {
  const Image mapped = aces_tone_mapped({1, 1, 3, {r, g, b}});
  return {static_cast<double>(mapped.values[0]), static_cast<double>(mapped.values[1]),
          static_cast<double>(mapped.values[2])};
}

// ACES puts 18 % grey at 4.8 of a cinema's 48 cd/m², and raises luminances to 0.9811 for the brighter rooms
// that screens stand in; grey stays grey, and white is reached 6.5 stops above 18 %, black as far below.
TEST(ToneMap, ShowsGreysAsAcesSays) {
  EXPECT_NEAR(shown(0.18f, 0.18f, 0.18f)[1], std::pow(0.1, 0.9811), 0.001);
  EXPECT_NEAR(shown(0.002f, 0.002f, 0.002f)[1], 0, 1e-4);
  EXPECT_NEAR(shown(16.3f, 16.3f, 16.3f)[1], 1, 0.005);
  EXPECT_EQ(shown(1e6f, 1e6f, 1e6f)[1], 1);
  for (const float grey : {0.01f, 0.18f, 1.0f, 4.0f}) {
    const auto [r, g, b] = shown(grey, grey, grey);
    EXPECT_NEAR(r / g, 1, 1e-3) << grey;
    EXPECT_NEAR(b / g, 1, 1e-3) << grey;
  }
}

TEST(ToneMap, IsMonotonicAndPalesBrightColours) {
  double last = -1;
  for (float grey = 0.003f; grey < 20; grey *= 1.5f) {
    const double y = shown(grey, grey, grey)[1];
    EXPECT_GT(y, last);
    last = y;
  }
  const auto dark = shown(0.1f, 0.01f, 0.01f), bright = shown(20, 2, 2);
  EXPECT_GT(dark[0] / dark[1], 3 * bright[0] / bright[1]);
}

}  // namespace
}  // namespace vitrail::tone_map_test
