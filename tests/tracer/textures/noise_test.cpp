// SPDX-License-Identifier: Apache-2.0
// Noise against its definition, written down a second time.
#include "tracer/textures/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::noise_test {
namespace {

constexpr int points = 20'000;

// Calls f(point) for points within ±`size`.
template <class F>
void for_points(double size, F&& f) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-size, size);
  for (int i = 0; i < points; ++i) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    f(Point3d{x, y, z});
  }
}

// What Perlin's reference implementation (2002) gives there; its corners have none of the two gradients in
// which pbrt's differ.
TEST(Noise, IsPerlins) {
  EXPECT_NEAR(perlin_noise({3.14, 42, 7}), 0.13691995878400012, 1e-15);
  // pbrt's gradients, as a table of vectors in a program of its own.
  EXPECT_NEAR(perlin_noise({0.3, 1.7, -2.4}), -0.43352592425441305, 1e-14);
  EXPECT_NEAR(perlin_noise({12.1, -3.6, 0.5}), -0.018112000000000027, 1e-14);
  EXPECT_NEAR(perlin_noise({100.25, 200.75, -37.125}), 0.29388830985408276, 1e-14);
  EXPECT_NEAR(perlin_noise({-4.2, 10, 9.1}), perlin_noise({-4.2 + 256, 10 - 512, 9.1 + 768}), 1e-12);
}

TEST(Noise, IsZeroAtIntegersAndWithinOne) {
  double sum = 0, absolute = 0;
  for_points(300, [&](Point3d p) {
    EXPECT_EQ(perlin_noise({std::floor(p.x), std::floor(p.y), std::floor(p.z)}), 0);
    const double n = perlin_noise(p);
    EXPECT_LE(std::abs(n), 1);
    sum += n, absolute += std::abs(n);
  });
  EXPECT_NEAR(sum / points, 0, 0.01);
  EXPECT_NEAR(absolute / points, 0.2, 0.03);  // what pbrt takes for octaves that it leaves out
  EXPECT_EQ(perlin_noise({1e300, 0.5, 0.5}), 0);
  EXPECT_EQ(perlin_noise({0.5, std::nan(""), 0.5}), 0);
}

// Continuous, with continuous slopes, across the faces of cells.
TEST(Noise, IsSmoothAcrossCells) {
  for_points(20, [&](Point3d p) {
    constexpr double h = 1e-5;
    const double x = std::floor(p.x);
    const double below = perlin_noise({x - h, p.y, p.z}), at = perlin_noise({x, p.y, p.z}),
                 above = perlin_noise({x + h, p.y, p.z});
    EXPECT_NEAR((above - at) / h, (at - below) / h, 1e-3);
  });
}

TEST(Noise, SumsOctaves) {
  const auto octave = [](Point3d p, double f) { return perlin_noise({f * p.x, f * p.y, f * p.z}); };
  NoiseTexture fbm, wrinkled, windy;
  fbm.octaves = 3, fbm.roughness = 0.75f;
  wrinkled.kind = NoiseTexture::Kind::wrinkled, wrinkled.octaves = 2, wrinkled.roughness = 0.5f;
  windy.kind = NoiseTexture::Kind::windy;
  for_points(9, [&](Point3d p) {
    const double a = octave(p, 1), b = octave(p, 1.99), c = octave(p, 1.99 * 1.99);
    EXPECT_NEAR(noise_value(fbm, p), a + 0.75 * b + 0.5625 * c, 1e-12);
    EXPECT_NEAR(noise_value(wrinkled, p), std::abs(a) + 0.5 * std::abs(b) + 0.25 * 0.2, 1e-12);
    const double wind = octave(p, 0.1) + 0.5 * octave(p, 0.199) + 0.25 * octave(p, 0.199 * 1.99);
    EXPECT_NEAR(noise_value(windy, p), std::abs(wind) * fractal_noise(p, 0.5, 6), 1e-12);
  });
  fbm.octaves = 0;
  EXPECT_EQ(noise_value(fbm, {0.3, 0.4, 0.5}), 0);
}

TEST(Marble, FollowsItsCurve) {
  NoiseTexture calm;
  calm.kind = NoiseTexture::Kind::marble, calm.variation = 0, calm.scale = 2;
  const auto at = [&](double y) { return marble_weights(calm, {7, y, 9}); };
  const double quarter = std::acos(-1.0) / 4;  // of the scaled wave
  // The curve's ends: the first point is the first colour, and so is the last.
  EXPECT_NEAR(at(-quarter)[0], 1, 1e-12);
  EXPECT_NEAR(at(quarter)[0], 1, 1e-12);
  // In the middle (sine 0) the fourth of six segments begins: with the second colour.
  EXPECT_NEAR(at(0)[1], 1, 1e-12);
  NoiseTexture marble;
  marble.kind = NoiseTexture::Kind::marble;
  std::array<double, marble_color_count> mean{};
  for_points(40, [&](Point3d p) {
    const auto weights = marble_weights(marble, p);
    double sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      EXPECT_GE(weights[k], 0);
      sum += weights[k], mean[k] += weights[k] / points;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  });
  for (const double share : mean) EXPECT_GT(share, 0.05);
}

TEST(Marble, ColorsAreTheirFits) {
  for (const SigmoidSpectrum& color : marble_colors) {
    const SigmoidSpectrum fitted = reflectance_from_rgb({color.rgb[0], color.rgb[1], color.rgb[2]});
    for (double nm = 360; nm <= 830; nm += 5) EXPECT_NEAR(evaluate(color, nm), evaluate(fitted, nm), 1e-5);
  }
}

// Every dot is a disc of radius 0.35 within its cell, which it covers the middle of.
TEST(Dots, AreDiscsInTwoOfFiveCells) {
  int dots = 0, looked_at = 0;
  for (int s = 0; s < 256; ++s)
    for (int t = 0; t < 256; ++t) {
      const bool is_there = inside_dot(s, t);
      dots += is_there;
      if (++looked_at % 97 != 0) continue;
      int inside = 0;
      constexpr int steps = 40;
      for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j)
          inside += inside_dot(s - 0.5 + (i + 0.5) / steps, t - 0.5 + (j + 0.5) / steps);
      const double area = is_there ? std::acos(-1.0) * 0.35 * 0.35 : 0;
      EXPECT_NEAR(inside / double{steps * steps}, area, 0.01);
    }
  EXPECT_NEAR(dots / 65536.0, 0.394, 0.001);
}

}  // namespace
}  // namespace vitrail::noise_test
