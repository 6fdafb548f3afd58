// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/spot_falloff.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vitrail::spot_falloff_test {
namespace {

using enum SpotLight::Falloff;
constexpr double radians = std::numbers::pi / 180;

double intensity(SpotLight::Falloff falloff, double beam_deg, double cutoff_deg, double theta_deg) {
  if (theta_deg <= beam_deg) return 1;
  if (theta_deg >= cutoff_deg) return 0;
  if (falloff == linear) return (cutoff_deg - theta_deg) / (cutoff_deg - beam_deg);
  const double edge = std::cos(cutoff_deg * radians),
               t = (std::cos(theta_deg * radians) - edge) / (std::cos(beam_deg * radians) - edge);
  return falloff == quartic ? std::pow(t, 4) : t * t * (3 - 2 * t);
}

// ∫ f sin θ dθ
double flux(SpotLight::Falloff falloff, double beam_deg, double cutoff_deg) {
  double sum = 0;
  constexpr int steps = 100000;
  for (int i = 0; i < steps; ++i) {
    const double theta_deg = 180.0 * (i + 0.5) / steps;
    sum += intensity(falloff, beam_deg, cutoff_deg, theta_deg) * std::sin(theta_deg * radians);
  }
  return sum * std::numbers::pi / steps;
}

TEST(SpotFalloff, FluxIsKept) {
  for (const auto& [beam, cutoff] : {std::pair{25.0f, 30.0f}, {0.0f, 40.0f}, {10.0f, 80.0f}, {2.0f, 3.0f}})
    for (const SpotLight::Falloff from : {smoothstep, quartic, linear})
      for (const SpotLight::Falloff to : {smoothstep, linear}) {
        SpotLight light;
        light.beam_deg = beam, light.cutoff_deg = cutoff, light.falloff = from;
        const MatchedSpot made = matched_spot(light, to);
        const double expected = flux(from, beam, cutoff);
        EXPECT_NEAR(flux(to, made.beam_deg, made.cutoff_deg), expected, 2e-4 * expected)
            << beam << " " << cutoff << " " << static_cast<int>(from) << static_cast<int>(to);
        double difference = 0;
        for (double theta = 0; theta < 120; theta += 0.01)
          difference = std::max(difference, std::abs(intensity(from, beam, cutoff, theta) -
                                                     intensity(to, made.beam_deg, made.cutoff_deg, theta)));
        EXPECT_NEAR(made.difference, difference, 0.01);
        EXPECT_LT(made.difference, 0.3);
      }
}

TEST(SpotFalloff, TheSameStaysAndHardEdgesToo) {
  SpotLight light;
  light.beam_deg = 12.5f, light.cutoff_deg = 33.25f;
  const MatchedSpot same = matched_spot(light, smoothstep);
  EXPECT_EQ(same.beam_deg, 12.5);
  EXPECT_EQ(same.cutoff_deg, 33.25);
  EXPECT_EQ(same.difference, 0);
  light.beam_deg = light.cutoff_deg;
  EXPECT_EQ(matched_spot(light, linear).beam_deg, 33.25);
}

}  // namespace
}  // namespace vitrail::spot_falloff_test
