// SPDX-License-Identifier: Apache-2.0
// What is recommended, of programs that only pretend and whose noise and bias are therefore known.
#include "measure/recommend.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include "film/film_progress.h"
#include "measure/biases.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::recommend_test {
namespace {

using Words = std::vector<std::string>;

bool has(const Words& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

const std::string& after(const Words& words, const std::string& option) {
  return *std::next(std::ranges::find(words, option));
}

// Of a picture that is rendered with these words.
struct Pretended {
  double mean = 1, variance = 0, sample_s = 1;
};
using Pretend = std::function<Pretended(const Words& words, int spp)>;

constexpr int side = 48;

void render(const Words& words, const Pretend& pretend) {
  const int spp = std::stoi(after(words, "--spp"));
  const std::uint64_t seed = std::stoull(after(words, "--seed"));
  const Pretended p = pretend(words, spp);
  FilmSettings settings;
  settings.width = settings.height = side;
  settings.crop = {0, side, 0, side};
  Film film(settings, {1, seed, 5});
  std::mt19937_64 random(seed * 1000 + static_cast<std::uint64_t>(spp));
  std::normal_distribution<double> noise(0, std::sqrt(p.variance));
  for (std::uint32_t i = 0; i < film.pixels(); ++i) {
    film.count_sample(i, 0);
    const double v = p.mean + noise(random);
    film.deposit(i, 0, srgb_to_xyz(RGB{v, v, v}));
  }
  write_film(after(words, "-o"), film, {1, 1, {1}, 1});
  std::ofstream(after(words, "--stats"))
      << fmt::format(R"({{"cpu_s": {0}, "wall_s": {0}}})", spp * p.sample_s);
}

Measurement measured(MeasureOptions options, const Pretend& pretend) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "scene.pbrt") << "never read";
  options.scene = directory / "scene.pbrt", options.folder = directory / "out";
  options.farm.ranks = 0;
  options.width = side;
  options.spp = 4, options.reference_spp = 4096;
  const Execute execute = [&](const std::string& program, const Words& words, const std::filesystem::path&) {
    if (program == "vitrail-render") return render(words, pretend);
    const std::filesystem::path bundle = after(words, "-o");
    std::filesystem::create_directories(bundle);
    std::ofstream(bundle / "manifest.json") << fmt::format(
        R"({{"film": {{"width_px": {}}}, "settings": {{"samples_per_pixel": 64, "direct_only": false}}}})",
        side);
  };
  return measure(options, execute, {[](const std::string&) {}, [](double, const char*) {}});
}

TEST(Biases, AreJudgedWithTheirIntervals) {
  EXPECT_EQ(judge({0.004, 0.005}, 0.01), LightVerdict::within);
  EXPECT_EQ(judge({-0.004, 0.007}, 0.01), LightVerdict::unsure);
  EXPECT_EQ(judge({-0.8, 0.1}, 0.01), LightVerdict::beyond);
  EXPECT_EQ(judge({0, 0}, 0.01), LightVerdict::within);
}

// Early roulette has half the noise of the scene's own at 4 samples, but its noise falls slower: with the
// slope of the scene's own it would have the error at 28 samples, and has 1.8 times as much there.
TEST(Recommendation, PromisesWhatWasRendered) {
  const auto variance = [](const Words& words, double spp) {
    return has(words, "early") ? 0.125 * std::pow(spp / 4, -0.7) : 1 / spp;
  };
  MeasureOptions options;
  options.axes = {"roulette"};
  options.error = 0.0178;
  const Measurement m = measured(options, [&](const Words& words, int spp) {
    return Pretended{1, variance(words, spp), has(words, "early") ? 0.2 : has(words, "never") ? 3 : 1.0};
  });
  ASSERT_EQ(m.recommendations.size(), 1u);
  const Recommendation& r = m.recommendations[0];
  ASSERT_TRUE(r.found);
  EXPECT_EQ(r.name, "roulette early");
  const double truth = variance(r.render, r.spp) / 1.01;
  EXPECT_EQ(r.rendered_spp, r.spp);
  EXPECT_GT(r.error_within, 0);
  EXPECT_NEAR(r.error, truth, 2 * r.error_within);
  EXPECT_LT(truth, 1.1 * *options.error);
  EXPECT_GT(truth, 0.7 * *options.error) << "more samples than it takes";
}

// Without a goal: what the scene's own setting has at the samples that the scene says.
TEST(Recommendation, MeetsTheScenesOwnWithoutAGoal) {
  MeasureOptions options;
  options.axes = {"roulette"};
  options.most_bias = 0.25;
  const Measurement m = measured(options, [](const Words&, int spp) { return Pretended{1, 1.0 / spp, 1}; });
  EXPECT_EQ(m.scene_spp, 64);
  EXPECT_EQ(m.most_bias, 0.25);
  ASSERT_EQ(m.recommendations.size(), 2u);
  for (const Recommendation& r : m.recommendations) {
    EXPECT_NE(r.goal.find("at its 64 samples"), std::string::npos) << r.goal;
    ASSERT_TRUE(r.found);
    EXPECT_EQ(r.most_bias, 0.25);
    EXPECT_NEAR(r.spp, 64, 16);
  }
}

// What would take longer to render than the budget has is not promised.
TEST(Recommendation, SaysWhatItDidNotRender) {
  MeasureOptions options;
  options.axes = {"roulette"};
  options.error = 1e-4;
  options.budget_s = 3000;
  const Measurement m = measured(options, [](const Words&, int spp) { return Pretended{1, 1.0 / spp, 1}; });
  const Recommendation& r = m.recommendations.at(0);
  ASSERT_TRUE(r.found);
  EXPECT_NEAR(r.spp, 1e4, 2e3);
  EXPECT_LE(r.rendered_spp, 500) << "3000 s are 6 pictures of 500 samples";
  EXPECT_GT(r.rendered_spp, 100);
  EXPECT_GT(r.error_within, 0.5 * r.error);
}

// One event a path is quick, without noise, and keeps a fifth of the light of a dark picture, where relMSE is
// small.
TEST(Recommendation, LeavesOutWhatTakesLight) {
  MeasureOptions options;
  options.axes = {"depth"};
  options.error = 1e-3;
  const auto pretend = [](const Words& words, int spp) {
    const int depth = has(words, "--max-depth") ? std::stoi(after(words, "--max-depth")) : -1;
    const double share = depth < 0 ? 1 : 1 - std::pow(0.8, depth);
    return Pretended{0.003 * share, 4e-6 / spp, depth < 0 ? 10 : 0.1 * depth};
  };
  const Recommendation bounded = measured(options, pretend).recommendations.at(0);
  ASSERT_TRUE(bounded.found);
  EXPECT_NEAR(bounded.luminance.value, 0, 0.01);
  EXPECT_TRUE(bounded.render.empty() || bounded.render[1] == "-1") << bounded.name;
  options.most_bias = 1;
  const Recommendation free = measured(options, pretend).recommendations.at(0);
  ASSERT_TRUE(free.found);
  EXPECT_EQ(free.name, "depth 1");
  EXPECT_LT(free.luminance.value, -0.75);
}

}  // namespace
}  // namespace vitrail::test::recommend_test
