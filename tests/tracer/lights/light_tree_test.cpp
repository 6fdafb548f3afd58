// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/light_tree.h"

#include <gtest/gtest.h>

#include "scene/geometry/portable_math.h"
#include "tests/tracer/lights/light_fixtures.h"

namespace vitrail::light_tree_test {

namespace {

using test::Random;

// One-sided and two-sided triangles, a few points and spots among them; powers over five decades.
std::vector<LightBounds> mixed_lights(std::size_t count, Random& random) {
  std::vector<LightBounds> lights;
  for (std::size_t i = 0; i < count; ++i) {
    LightBounds b;
    const Point3d p = random.point(-3, 5);
    extend(b.box, p);
    b.axis = random.direction();
    b.theta_e_rad = pi / 2;
    b.power = portable_exp(random.between(-6, 6));
    if (i % 7 == 3) {
      b.theta_o_rad = pi;
    } else if (i % 7 == 5) {
      b.theta_o_rad = 0.4;
      b.theta_e_rad = 0.01;
    } else {
      b.two_sided = i % 2 == 0;
      for (int k = 0; k < 2; ++k) extend(b.box, p + random.direction() * 0.1);
    }
    lights.push_back(b);
  }
  return lights;
}

// Small lights that shine down from the unit square at z = 0, their powers e^(±spread).
std::vector<LightBounds> ceiling(std::size_t count, double spread, Random& random) {
  std::vector<LightBounds> lights(count);
  for (LightBounds& l : lights) {
    const Point3d p{random(), random(), 0};
    for (int k = 0; k < 3; ++k) extend(l.box, p + Vector3d{random(), random(), 0} * 0.02);
    l.axis = {0, 0, -1};
    l.theta_e_rad = pi / 2;
    l.power = portable_exp(random.between(-spread, spread));
  }
  return lights;
}

}  // namespace

TEST(LightTree, ProbabilitiesOfAllLightsSumToOneOrToWhatIsReached) {
  Random random(1);
  for (const LightChoice choice : {LightChoice::tree, LightChoice::power})
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 31u, 500u}) {
      const std::vector<LightBounds> lights = mixed_lights(count, random);
      const LightTree tree(lights, choice);
      double mean = 0;
      for (int i = 0; i < 40; ++i) {
        const Point3d p = random.point(-6, 8);
        double sum = 0;
        for (std::uint32_t l = 0; l < count; ++l) sum += tree.probability(p, l);
        ASSERT_LE(sum, 1 + 1e-6);
        ASSERT_GE(sum, choice == LightChoice::power ? 1 - 1e-6 : 0.8);
        mean += sum / 40;
      }
      EXPECT_GT(mean, 0.95);  // some nodes promise what none of their children holds
    }
}

TEST(LightTree, ChoosesWithTheProbabilityThatItSays) {
  Random random(2);
  const std::vector<LightBounds> lights = mixed_lights(60, random);
  const LightTree tree(lights, LightChoice::tree);
  for (int i = 0; i < 8; ++i) {
    const Point3d p = random.point(-6, 8);
    constexpr int samples = 20000;
    std::vector<int> counts(lights.size() + 1, 0);
    for (int s = 0; s < samples; ++s) {
      const auto chosen = tree.choose(p, (s + 0.5) / samples);
      ++counts[chosen ? tree.order()[chosen->slot] : lights.size()];
      if (chosen) {
        ASSERT_EQ(chosen->probability, tree.probability(p, tree.order()[chosen->slot]));
        ASSERT_GT(chosen->probability, 0);
      }
    }
    // Evenly spaced numbers meet every light's interval to ± a few of them.
    for (std::uint32_t l = 0; l < lights.size(); ++l)
      EXPECT_NEAR(counts[l], tree.probability(p, l) * samples, 4) << "light " << l;
  }
}

// A lamp of many triangles, of even or of very different powers; seen from far away they are alike, and
// chosen by power.
TEST(LightTree, ChoosesAmongLightsThatAreAlikeWithTheProbabilityThatItSays) {
  Random random(4);
  for (const double spread : {0.0, 1.0, 6.0}) {
    const std::vector<LightBounds> lights = ceiling(1000, spread, random);
    const LightTree tree(lights, LightChoice::tree);
    for (const double height : {0.01, 0.3, 2.0, 10.0}) {
      const Point3d p{random(), random(), -height};
      constexpr int samples = 100000;
      std::vector<int> counts(lights.size(), 0);
      for (int s = 0; s < samples; ++s) {
        const auto chosen = tree.choose(p, (s + 0.5) / samples);
        ASSERT_TRUE(chosen);
        ++counts[tree.order()[chosen->slot]];
        ASSERT_EQ(chosen->probability, tree.probability(p, tree.order()[chosen->slot]));
      }
      double sum = 0;
      for (std::uint32_t l = 0; l < lights.size(); ++l) {
        const double probability = tree.probability(p, l);
        EXPECT_NEAR(counts[l], probability * samples, 2) << "light " << l;
        if (height >= 10) {
          EXPECT_NEAR(probability, lights[l].power / tree.power(), 0.1 * probability);
        }
        sum += probability;
      }
      EXPECT_NEAR(sum, 1, 1e-6);
    }
  }
}

// More nodes than a point keeps, each of which it meets again after others.
TEST(LightTree, ChoosesTheSameForAPointThatIsAskedAgain) {
  Random random(6);
  for (const LightChoice choice : {LightChoice::tree, LightChoice::power})
    for (const std::size_t count : {0u, 1u, 7u, 60u, 3000u}) {
      const LightTree tree(mixed_lights(count, random), choice);
      for (int i = 0; i < 20; ++i) {
        const Point3d p = random.point(-6, 8);
        LightTree::Point point(tree, p);
        for (int k = 0; k < 200; ++k) {
          const double u = random();
          const auto once = tree.choose(p, u), again = point.choose(u);
          ASSERT_EQ(once.has_value(), again.has_value());
          if (!once) continue;
          ASSERT_EQ(once->slot, again->slot);
          ASSERT_EQ(once->probability, again->probability);
          ASSERT_EQ(once->rest, again->rest);
        }
      }
    }
}

// What is lost in a sum of powers is found by the nodes.
TEST(LightTree, KeepsCandlesBesideASun) {
  Random random(5);
  std::vector<LightBounds> lights = ceiling(500, 0, random);
  for (std::size_t i = 0; i < 250; ++i) lights[i].power *= 1e30;
  const LightTree tree(lights, LightChoice::tree);
  for (const double height : {0.1, 1000.0})
    for (std::uint32_t l = 0; l < lights.size(); ++l) EXPECT_GT(tree.probability({0.5, 0.5, -height}, l), 0);
}

// A light may be left out only where it sends nothing.
TEST(LightTree, NeverLeavesOutALightThatReachesThePoint) {
  Random random(3);
  std::vector<LightBounds> lights;
  std::vector<std::array<Point3d, 3>> corners;
  for (int i = 0; i < 300; ++i) {
    std::array<Point3d, 3> c;
    c[0] = random.point(-1, 1);
    c[1] = c[0] + random.direction() * random.between(0.01, 0.5);
    c[2] = c[0] + random.direction() * random.between(0.01, 0.5);
    LightBounds b;
    for (const Point3d& x : c) extend(b.box, x);
    b.axis = normalize(cross(c[1] - c[0], c[2] - c[0]));
    b.theta_e_rad = pi / 2;
    b.power = random.between(0.1, 2);
    b.two_sided = i % 3 == 0;
    lights.push_back(b);
    corners.push_back(c);
  }
  const LightTree tree(lights, LightChoice::tree);
  for (int i = 0; i < 300; ++i) {
    const Point3d p = random.point(-2, 2);
    for (std::uint32_t l = 0; l < lights.size(); ++l) {
      double seen = lights[l].two_sided ? 1 : 0;
      for (const Point3d& c : corners[l]) seen = std::max(seen, dot(normalize(p - c), lights[l].axis));
      if (seen > 1e-3) {
        ASSERT_GT(tree.probability(p, l), 0) << i << " " << l;
      }
    }
  }
}

TEST(LightTree, PrefersWhatIsNearAndTurnedToThePoint) {
  std::vector<LightBounds> lights(3);
  const std::array<Point3d, 3> at{{{0, 0, 0}, {10, 0, 0}, {0, 0, 0}}};
  for (std::size_t i = 0; i < 3; ++i) {
    extend(lights[i].box, at[i]);
    lights[i].theta_e_rad = pi / 2;
    lights[i].power = 1;
    lights[i].axis = {0, 0, i == 2 ? -1.0 : 1.0};
  }
  const LightTree tree(lights, LightChoice::tree);
  EXPECT_NEAR(tree.probability({0, 0, 1}, 0), 1 / (1 + 1 / (101 * std::sqrt(101.0))), 1e-4);
  EXPECT_EQ(tree.probability({0, 0, 1}, 2), 0);
  EXPECT_FALSE(LightTree({}, LightChoice::tree).choose({0, 0, 0}, 0.5));
}

// Ten thousand at one place and one of another power far away: no tree is too deep for the trails.
TEST(LightTree, TakesLightsOnTopOfEachOther) {
  std::vector<LightBounds> lights(10001);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    extend(lights[i].box, i == 0 ? Point3d{1e6, 0, 0} : Point3d{0, 0, 0});
    lights[i].theta_o_rad = pi;
    lights[i].theta_e_rad = pi / 2;
    lights[i].power = i == 0 ? 1e12 : 1;
  }
  lights[5].power = 0;
  lights[6].power = std::numeric_limits<double>::infinity();
  const LightTree tree(lights, LightChoice::tree);
  const Point3d p{1, 2, 3};
  double sum = 0;
  for (std::uint32_t l = 0; l < lights.size(); ++l) sum += tree.probability(p, l);
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_EQ(tree.probability(p, 5), 0);
  EXPECT_EQ(tree.probability(p, 6), 0);
  EXPECT_TRUE(tree.choose({0, 0, 0}, 0.3));
  EXPECT_TRUE(tree.choose({1e300, -1e300, 0}, 0.3));
}

}  // namespace vitrail::light_tree_test
