// SPDX-License-Identifier: Apache-2.0
// Patterns against their closed forms. Those of noise: pattern_noise_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "scene/geometry/portable_math.h"
#include "scene/models/pattern.h"
#include "scene/models/pattern_noise.h"

namespace vitrail::pattern_test {
namespace {

using Kind = PatternTexture::Kind;
using Wave = PatternTexture::Wave;

PatternTexture of(Kind kind, Wave wave = Wave::ramp) {
  PatternTexture t;
  t.kind = kind, t.wave = wave;
  return t;
}

double rest(double x) { return x - std::floor(x); }
// What is beyond 0 … 1 repeats, as povray's does: each time by so much more.
double repeated(double x) {
  const double part = std::fmod(x, 1.00001);
  return part < 0 ? part + 1 : part;
}

// At points that are not on any edge.
void for_points(const std::function<void(Point3d)>& f) {
  for (int i = 0; i < 500; ++i) {
    const auto coordinate = [&](double step) { return 12 * rest(0.123 + i * step) - 6; };
    f({coordinate(0.8191725), coordinate(0.6710436), coordinate(0.5497005)});
  }
}

void expect_values(const PatternTexture& t, const std::function<double(Point3d)>& expected) {
  for_points([&](Point3d p) {
    EXPECT_NEAR(pattern_value(t, p), expected(p), 1e-9) << p.x << " " << p.y << " " << p.z;
  });
}

TEST(Patterns, ThoseOfDistances) {
  const auto r = [](Point3d p) { return std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z); };
  expect_values(of(Kind::spherical), [&](Point3d p) { return std::max(1 - r(p), 0.0); });
  expect_values(of(Kind::cylindrical), [](Point3d p) { return std::max(1 - std::hypot(p.x, p.z), 0.0); });
  expect_values(of(Kind::planar), [](Point3d p) { return std::max(1 - std::abs(p.y), 0.0); });
  expect_values(of(Kind::boxed), [](Point3d p) {
    return std::max(1 - std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 0.0);
  });
  expect_values(of(Kind::onion), [&](Point3d p) { return rest(r(p)); });
  expect_values(of(Kind::wood, Wave::triangle),
                [](Point3d p) { return 1 - std::abs(2 * rest(repeated(std::hypot(p.x, p.y))) - 1); });
}

TEST(Patterns, ThoseOfCoordinates) {
  expect_values(of(Kind::marble, Wave::triangle),
                [](Point3d p) { return 1 - std::abs(2 * rest(repeated(p.x)) - 1); });
  PatternTexture slanted = of(Kind::gradient);
  slanted.direction = {2, 1, 0};
  expect_values(slanted, [](Point3d p) {
    const double along = (2 * p.x + p.y) / std::sqrt(5.0);
    return along > 1 ? rest(along) : repeated(along);
  });
  expect_values(of(Kind::leopard), [](Point3d p) {
    const double sum = (std::sin(p.x) + std::sin(p.y) + std::sin(p.z)) / 3;
    return sum * sum;
  });
  expect_values(of(Kind::radial), [](Point3d p) { return repeated(0.75 + std::atan2(p.x, p.z) / (2 * pi)); });
  PatternTexture arms = of(Kind::spiral1);
  arms.arms = 3;
  expect_values(arms, [](Point3d p) {
    const double turns = std::hypot(p.x, p.y) + p.z + 3 * rest(std::atan2(p.y, p.x) / (2 * pi) + 0.25);
    return repeated(turns);
  });
}

TEST(Patterns, Waves) {
  const auto with = [](Wave wave) {
    PatternTexture t = of(Kind::gradient, wave);
    t.frequency = 2, t.phase = 0.3f, t.exponent = 3;
    return t;
  };
  const auto x = [](Point3d p) {
    return repeated(2 * (p.x > 1 ? rest(p.x) : p.x) + static_cast<double>(0.3f));
  };
  expect_values(with(Wave::ramp), x);
  expect_values(with(Wave::triangle), [&](Point3d p) { return 1 - std::abs(2 * x(p) - 1); });
  expect_values(with(Wave::sine), [&](Point3d p) { return (1 + std::sin(2 * pi * x(p))) / 2; });
  expect_values(with(Wave::scallop), [&](Point3d p) { return std::abs(std::sin(pi * x(p))); });
  expect_values(with(Wave::cubic), [&](Point3d p) { return x(p) * x(p) * (3 - 2 * x(p)); });
  expect_values(with(Wave::poly), [&](Point3d p) { return x(p) * x(p) * x(p); });
  // As povray: what is above 1 repeats before the frequency counts, what is below 0 after it.
  PatternTexture t = of(Kind::gradient);
  t.frequency = 1.5f;
  expect_values(t, [](Point3d p) { return repeated(1.5 * (p.x > 1 ? rest(p.x) : p.x)); });
}

using Op = PatternStep::Op;

PatternTexture formula(std::vector<PatternStep> steps) {
  PatternTexture t = of(Kind::formula);
  t.steps = std::move(steps);
  return t;
}

TEST(Patterns, FormulasAreCarriedOut) {
  // x·y + ⅓ of a number that is picked twice and dropped
  const PatternTexture t = formula({{Op::pick, 0},
                                    {Op::pick, 1},
                                    {Op::multiply},
                                    {Op::pick, 6},
                                    {Op::constant, 0, 3},
                                    {Op::divide},
                                    {Op::pick, 7},
                                    {Op::pick, 6},
                                    {Op::add},
                                    {Op::slide, 2}});
  ASSERT_EQ(fault_of(t), nullptr);
  EXPECT_NEAR(pattern_value(t, {0.5, 0.6, 9}), 0.4, 1e-15);
  EXPECT_EQ(pattern_value(formula({{Op::pick, 0}}), {1, 0, 0}), 1);
  EXPECT_NEAR(pattern_value(formula({{Op::pick, 0}}), {1.25, 0, 0}), 0.25, 1e-15);
  const PatternTexture normal = formula({{Op::pick, 5}});
  EXPECT_EQ(pattern_value(normal, {1, 2, 3}, {0, 0.6, 0.8}), 0.8);
  EXPECT_EQ(pattern_value(formula({{Op::pick, 0}, {Op::ln}}), {-1, 0, 0}), 0);
}

TEST(Patterns, PatternsAndFractalsOfFormulas) {
  PatternTexture t = formula({{Op::constant}, {Op::pick, 0}, {Op::constant}, {Op::pattern, 0}});
  t.patterns = {of(Kind::planar)};
  t.patterns[0].map = {{0, ConstantSpectrum{0.5f}}, {1, ConstantSpectrum{0.75f}}};
  ASSERT_EQ(fault_of(t), nullptr);
  EXPECT_NEAR(pattern_value(t, {0.4, 0, 0}), 0.65, 1e-7);
  EXPECT_EQ(pattern_value(t, {std::nan(""), 0, 0}), 0);
  t = formula({{Op::pick, 0}, {Op::pick, 1}, {Op::fractal, 0}});
  t.fractals.resize(1);
  t.fractals[0].iterations = 100;
  ASSERT_EQ(fault_of(t), nullptr);
  for_points([&](Point3d p) {
    EXPECT_EQ(pattern_value(t, p), pattern_value(of(Kind::mandel), p)) << p.x << " " << p.y;
  });
}

TEST(Patterns, FormulasThatAreRefused) {
  const auto refused = [](std::vector<PatternStep> steps, std::vector<PatternTexture> patterns = {}) {
    PatternTexture t = formula(std::move(steps));
    t.patterns = std::move(patterns);
    return fault_of(t) != nullptr;
  };
  EXPECT_FALSE(refused({{Op::pick, 5}}));
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused({{Op::pick, 6}}));
  EXPECT_TRUE(refused({{Op::slide, 6}}));
  EXPECT_FALSE(refused({{Op::slide, 5}}));
  EXPECT_TRUE(refused({{Op::slide, 5}, {Op::add}}));
  EXPECT_TRUE(refused({{Op::ridged_mf}}));
  EXPECT_TRUE(refused({{Op::fractal, 0}}));
  EXPECT_TRUE(refused({{Op::pattern, 1}}, {PatternTexture{}}));
  EXPECT_FALSE(refused({{Op::pattern, 0}}, {PatternTexture{}}));
  EXPECT_TRUE(refused({{Op::pattern, 0}}, {formula({{Op::pick, 0}})}));
  PatternTexture of_textures;
  of_textures.map = {{0, Id<Texture>{0}}};
  EXPECT_TRUE(refused({{Op::pattern, 0}}, {of_textures}));
  EXPECT_TRUE(refused(std::vector<PatternStep>(most_formula_operands, {Op::constant})));
  EXPECT_TRUE(refused(std::vector<PatternStep>(most_formula_steps + 1, {Op::negate})));
  PatternTexture slow = formula({});
  slow.fractals.resize(1);
  slow.fractals[0].iterations = 10000;
  for (int i = 0; i < 10; ++i)
    for (const PatternStep step : {PatternStep{Op::pick, 0}, {Op::pick, 1}, {Op::fractal, 0}, {Op::add}})
      slow.steps.push_back(step);
  EXPECT_NE(fault_of(slow), nullptr);
}

TEST(Patterns, ThoseOfPlaces) {
  const auto place = [](Kind kind, Point3d p) {
    PatternTexture t = of(kind);
    t.map.resize(3);
    return pattern_mix(t, p).first;
  };
  for_points([&](Point3d p) {
    const int cells = static_cast<int>(std::floor(p.x)) + static_cast<int>(std::floor(p.y)) +
                      static_cast<int>(std::floor(p.z));
    EXPECT_EQ(place(Kind::checker, p), static_cast<std::size_t>(cells & 1));
  });
  // As POV-Ray's picture: the hexagon around 0 is the first, those around it are the others in turn.
  EXPECT_EQ(place(Kind::hexagon, {0, 5, 0}), 0u);
  const double across = std::sqrt(3.0);
  for (int i = 0; i < 6; ++i) {
    const double angle = pi / 6 + i * pi / 3;
    EXPECT_EQ(place(Kind::hexagon, {across * std::cos(angle), 0, across * std::sin(angle)}),
              i % 2 == 0 ? 2u : 1u)
        << i;
  }
  // Just within the corner of the first, and beyond it.
  EXPECT_EQ(place(Kind::hexagon, {0.99, 0, 0}), 0u);
  EXPECT_NE(place(Kind::hexagon, {1.01, 0, 0.1}), 0u);
  // Wherever a point lies, it is in the hexagon whose centre is the nearest.
  for_points([&](Point3d p) {
    double nearest = 1e9;
    int found = 0;
    for (int i = -12; i <= 12; ++i)
      for (int j = -12; j <= 12; ++j) {
        const double distance = std::hypot(p.x - 1.5 * i, p.z - across * (j + 0.5 * i));
        if (distance < nearest) nearest = distance, found = ((2 * i + j) % 3 + 3) % 3;
      }
    EXPECT_EQ(place(Kind::hexagon, p), static_cast<std::size_t>(found)) << p.x << " " << p.z;
  });
  // Bricks of 8 × 3 × 4.5 that end in mortar of ½; layers are half a brick on along x and along z in turn, as
  // in POV-Ray's pictures.
  EXPECT_EQ(place(Kind::brick, {3, 1, 1}), 1u);
  EXPECT_EQ(place(Kind::brick, {-0.25, 1, 1}), 0u);
  EXPECT_EQ(place(Kind::brick, {3, -0.25, 1}), 0u);
  EXPECT_EQ(place(Kind::brick, {3, 1, -0.25}), 1u);
  EXPECT_EQ(place(Kind::brick, {3, 1, 2}), 0u);
  EXPECT_EQ(place(Kind::brick, {-0.25, 4, 1}), 1u);
  EXPECT_EQ(place(Kind::brick, {3.75, 4, 1}), 0u);
  EXPECT_EQ(place(Kind::brick, {2, 4, -0.25}), 0u);
  EXPECT_EQ(place(Kind::brick, {2, 4, 2}), 1u);
}

TEST(Patterns, MapsAreMixedBetweenTheirStops) {
  PatternTexture t = of(Kind::gradient);
  t.map = {{0.25f, ConstantSpectrum{0}}, {0.75f, ConstantSpectrum{1}}, {0.75f, ConstantSpectrum{0.5f}}};
  const auto expect = [&](double x, std::size_t first, std::size_t second, double amount) {
    const PatternMix mix = pattern_mix(t, {x, 0, 0});
    EXPECT_EQ(mix.first, first) << x;
    EXPECT_EQ(mix.second, second) << x;
    EXPECT_NEAR(mix.amount, amount, 1e-12) << x;
  };
  expect(0.1, 0, 0, 0);
  expect(0.25, 0, 1, 0);
  expect(0.5, 0, 1, 0.5);
  expect(0.75, 2, 2, 0);
  expect(0.9, 2, 2, 0);
}

TEST(Patterns, TilesAndTurbulence) {
  PatternTexture t = of(Kind::gradient);
  t.direction = {0, 1, 0};
  t.repeat = {0, 0.25, 0};
  EXPECT_NEAR(pattern_value(t, {7, 3.3, 1}), rest(3.3 / 0.25) * 0.25, 1e-12);
  PatternTexture moved = of(Kind::gradient);
  moved.turbulence.amount = {0.2, 5, 5};
  moved.turbulence.octaves = 1;
  for_points([&](Point3d p) {
    const double way = rest(pattern_value(moved, p) - p.x + 0.5) - 0.5;
    EXPECT_NEAR(way, 0.2 * vector_noise(p).x, 1e-4);
  });
}

// Mean and standard deviation over a cube.
struct Statistics {
  double mean = 0, deviation = 0;
};
Statistics statistics(const std::function<double(Point3d)>& value) {
  constexpr int n = 40000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const auto coordinate = [&](double step) { return 80 * rest(0.5 + i * step); };
    const double v = value({coordinate(0.8191725), coordinate(0.6710436), coordinate(0.5497005)});
    sum += v, squares += v * v;
  }
  return {sum / n, std::sqrt(squares / n - sum / n * (sum / n))};
}

// By a search of all cells around.
TEST(Patterns, CrackleFindsTheNearest) {
  const auto by_search = [](Point3d p) {
    double best = 1e9;
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j)
        for (int k = -4; k <= 4; ++k) {
          const auto x = static_cast<std::int64_t>(std::floor(p.x)) + i,
                     y = static_cast<std::int64_t>(std::floor(p.y)) + j,
                     z = static_cast<std::int64_t>(std::floor(p.z)) + k;
          const auto n = numbers_of_cell(x, y, z);
          best = std::min(best, length(Point3d{static_cast<double>(x) + n[0], static_cast<double>(y) + n[1],
                                               static_cast<double>(z) + n[2]} -
                                       p));
        }
    return std::min(best, 1.0);
  };
  PatternTexture t = of(Kind::crackle);
  t.crackle.form = {1, 0, 0};
  expect_values(t, by_search);
}

// What POV-Ray 3.7's pixels show over 900 cells, whose own spread is a hundredth.
TEST(Patterns, CracklesOffsetIsAFourthAxis) {
  const auto mean = [](Vector3d form, float metric, float offset) {
    PatternTexture t = of(Kind::crackle);
    t.crackle = {form, metric, offset};
    return statistics([&](Point3d p) { return pattern_value(t, p); }).mean;
  };
  const Vector3d first{1, 0, 0}, edges{-1, 1, 0};
  EXPECT_NEAR(mean(first, 2, 0.5f), 0.735, 0.01);
  EXPECT_NEAR(mean(first, 2, -0.5f), 0.735, 0.01);
  EXPECT_NEAR(mean(first, 1, 0.5f), 0.979, 0.01);
  EXPECT_NEAR(mean(first, 1, -0.5f), 0.292, 0.01);
  EXPECT_NEAR(mean(first, 3, 0.5f), 0.631, 0.01);
  EXPECT_NEAR(mean(first, 3, -0.5f), 0.202, 0.012);
  EXPECT_NEAR(mean(first, 4, -0.5f), 0.591, 0.01);
  EXPECT_EQ(mean(first, 1.5f, -0.5f), 0);
  EXPECT_NEAR(mean(edges, 19, 0.571f), 0.043, 0.004);
  EXPECT_NEAR(mean(edges, 2, 0.571f), 0.130, 0.01);
  EXPECT_EQ(mean({-1, 0, 0}, 2, 0), 0) << "what is below 0 is 0";
}

TEST(Patterns, WhatMakesNoSense) {
  EXPECT_EQ(fault_of(PatternTexture{}), nullptr);
  PatternTexture t;
  t.turbulence.octaves = 11;
  EXPECT_NE(fault_of(t), nullptr);
  t = {};
  t.map = {{0.5f, ConstantSpectrum{1}}, {0.25f, ConstantSpectrum{1}}};
  EXPECT_NE(fault_of(t), nullptr);
  t = of(Kind::gradient);
  t.direction = {0, 0, 0};
  EXPECT_NE(fault_of(t), nullptr);
}

}  // namespace
}  // namespace vitrail::pattern_test
