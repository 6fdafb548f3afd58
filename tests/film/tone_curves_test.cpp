// SPDX-License-Identifier: Apache-2.0
#include "film/tone_curves.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene/spectra/color.h"

namespace vitrail::tone_curves_test {
namespace {

using Tones = Image (*)(const Image&);

std::array<double, 3> shown(Tones tones, float r, float g, float b) {
  const Image mapped = tones({1, 1, 3, {r, g, b}});
  return {static_cast<double>(mapped.values[0]), static_cast<double>(mapped.values[1]),
          static_cast<double>(mapped.values[2])};
}
double grey(Tones tones, double light) {
  const auto v = static_cast<float>(light);
  const auto [r, g, b] = shown(tones, v, v, v);
  EXPECT_NEAR(r, g, 1e-6);
  EXPECT_NEAR(b, g, 1e-6);
  return g;
}

// By the definitions: half of the encoded range in the middle, with slope 2 per 16.5 stops; the ends are the
// ends.
TEST(ToneCurves, AgxIsASigmoidOfStops) {
  const auto encoded = [](double light) { return std::pow(grey(agx_tone_mapped, light), 1 / 2.2); };
  EXPECT_NEAR(encoded(0.18), 0.5, 1e-6);
  EXPECT_NEAR(encoded(0.18 * std::exp2(0.05)) - encoded(0.18 * std::exp2(-0.05)), 2 * 0.1 / 16.5, 1e-5);
  EXPECT_NEAR(encoded(0.18 * std::exp2(3)), 0.837510, 1e-5);
  EXPECT_NEAR(encoded(0.18 * std::exp2(-5)), 0.062365, 1e-5);
  EXPECT_NEAR(encoded(0.18 * std::exp2(6.5)), 1, 1e-5);
  EXPECT_EQ(encoded(0.18 * std::exp2(-10.5)), 0);
  EXPECT_EQ(grey(agx_tone_mapped, 0), 0);
  EXPECT_EQ(grey(agx_tone_mapped, -1), 0);
}

// (x(Ax + CB) + DE) / (x(Ax + B) + DF) − E/F at 2, over that at 11.2.
TEST(ToneCurves, FilmicIsHablesCurve) {
  const double at_2 = (2 * (0.3 + 0.05) + 0.004) / (2 * (0.3 + 0.5) + 0.06) - 0.02 / 0.3,
               at_white = (11.2 * (1.68 + 0.05) + 0.004) / (11.2 * (1.68 + 0.5) + 0.06) - 0.02 / 0.3;
  EXPECT_NEAR(grey(filmic_tone_mapped, 1), at_2 / at_white, 1e-6);
  EXPECT_NEAR(grey(filmic_tone_mapped, 5.6), 1, 1e-6);
  EXPECT_NEAR(grey(filmic_tone_mapped, 0), 0, 1e-6);
}

TEST(ToneCurves, AreMonotonicAndAgxPalesBrightColours) {
  for (const Tones tones : {agx_tone_mapped, filmic_tone_mapped}) {
    double last = -1;
    for (double light = 0.003; light < 5; light *= 1.5) {
      const double y = grey(tones, light);
      EXPECT_GT(y, last);
      last = y;
    }
  }
  const auto dark = shown(agx_tone_mapped, 0.1f, 0.01f, 0.01f), bright = shown(agx_tone_mapped, 20, 2, 2);
  EXPECT_GT(dark[0] / dark[1], 3 * bright[0] / bright[1]);
}

TEST(ToneCurves, AutomaticExposureTakesTheLogAverageToMiddleGrey) {
  EXPECT_NEAR(automatic_exposure_ev({3, 1, 3, {0.09f, 0.09f, 0.09f, 0.36f, 0.36f, 0.36f, 0, 0, 0}}), 0, 1e-6);
  EXPECT_NEAR(automatic_exposure_ev({1, 1, 3, {0.72f, 0.72f, 0.72f}}), -2, 1e-6);
  EXPECT_EQ(automatic_exposure_ev({1, 1, 3, {0, 0, 0}}), 0);
}

TEST(ToneCurves, FittingExposureLeavesWhatIsNotFarAboveWhite) {
  const auto two = [](float a, float b) { return Image{2, 1, 3, {a, a, a, b, b, b}}; };
  EXPECT_EQ(fitting_exposure_ev(two(600, 0.1f)), 0);  // a lamp and a room
  EXPECT_EQ(fitting_exposure_ev(two(2, 2)), 0);       // a white background
  EXPECT_EQ(fitting_exposure_ev(two(0, 0)), 0);
  EXPECT_NEAR(fitting_exposure_ev(two(720, 0)), -std::log2(4000.0), 1e-4);  // cd/m²
}

}  // namespace
}  // namespace vitrail::tone_curves_test
