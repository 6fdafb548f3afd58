// SPDX-License-Identifier: Apache-2.0
#include "measure/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/axes.h"
#include "measure/plan.h"
#include "measure/words.h"
#include "scene/system/diagnostics.h"

namespace vitrail::model_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const ScalingLaw law{1, 2};
const Tradeoff honest{0.8, 0, 4, 3}, biased{0.2, 0.01, 4, 1};

TEST(Model, NoiseFallsAndBiasStays) {
  EXPECT_DOUBLE_EQ(predicted_error(biased, law, 4), 0.21);
  EXPECT_DOUBLE_EQ(predicted_error(biased, law, 40), 0.03);
  EXPECT_DOUBLE_EQ(predicted_cpu_s(honest, law, 10), 32);
  EXPECT_DOUBLE_EQ(predicted_error(honest, {2, 0}, 8), 0.2);
}

TEST(Model, ASampleTakesTime) {
  EXPECT_EQ(sample_time_s(3, 2, 1000), 1.5);
  EXPECT_DOUBLE_EQ(sample_time_s(-.01, 16, 576), 576 * 20e-9);  // a start that was measured too long
}

TEST(Model, SamplesReachAnErrorUnlessTheBiasIsGreater) {
  EXPECT_NEAR(samples_for_error(biased, law, 0.03).value(), 40, 1e-9);
  EXPECT_FALSE(samples_for_error(biased, law, 0.01));
  EXPECT_FALSE(samples_within(honest, law, 4.9));
  EXPECT_DOUBLE_EQ(samples_within(honest, law, 32).value(), 10);
}

TEST(Model, TheBestDependsOnTheGoal) {
  const Tradeoff both[] = {honest, biased};
  EXPECT_EQ(best(both, law, {0.1, {}}).value().index, 1u);    // the cheap one, while its bias does not matter
  EXPECT_EQ(best(both, law, {0.005, {}}).value().index, 0u);  // out of its reach
  EXPECT_EQ(best(both, law, {{}, 50.0}).value().index, 1u);
  EXPECT_EQ(best(both, law, {{}, 5000.0}).value().index, 0u);
  EXPECT_FALSE(best(both, law, {{}, 2.5}));
  const Prediction p = best(both, law, {0.03, {}}).value();
  EXPECT_EQ(p.spp, 40);
  EXPECT_LE(p.error, 0.03 + 1e-12);
}

TEST(Model, ChangesCombine) {
  const Tradeoff base{1, 0, 4, 2}, fast{1, 0.01, 4, 1}, quiet{0.5, 0.02, 4, 2};
  const Tradeoff changes[] = {fast, quiet};
  const Tradeoff t = combined(base, changes, law);
  EXPECT_DOUBLE_EQ(t.noise, 0.5);
  EXPECT_DOUBLE_EQ(t.sample_s, 1);
  EXPECT_DOUBLE_EQ(t.bias, 0.02);
}

// What was measured at more samples counts against as many of the others, and is not known below them.
TEST(Model, ChangesOfMoreSamplesCombine) {
  const Tradeoff base{1, 0, 4, 2}, adaptive{0.05, 0, 16, 2, 16};
  const Tradeoff t = combined(base, std::span(&adaptive, 1), law);
  EXPECT_DOUBLE_EQ(t.noise, 0.2);  // 0.05 of 0.25
  EXPECT_EQ(t.least_spp, 16);
  EXPECT_DOUBLE_EQ(samples_for_error(t, law, 10).value(), 16);
  EXPECT_FALSE(samples_within(t, law, 2 + 15.9 * 2));
  EXPECT_TRUE(samples_within(t, law, 2 + 16 * 2));
}

TEST(Model, TheSlopeIsFitted) {
  const double spp[] = {1, 4, 16}, noise[] = {1, 0.1767766953, 0.03125};
  EXPECT_NEAR(fitted_slope(spp, noise), 1.25, 1e-9);
  EXPECT_EQ(fitted_slope(std::span(spp, 1), std::span(noise, 1)), 1);
  const double same[] = {4, 4, 4};
  EXPECT_EQ(fitted_slope(same, noise), 1) << "counts that are all the same tell nothing";
  const double rising[] = {1, 2, 3};
  EXPECT_EQ(fitted_slope(spp, rising), 0.7);
}

TEST(Model, TheFrontIsWhatNothingBeats) {
  const double cost[] = {1, 2, 3, 2}, error[] = {3, 2, 2, 4};
  EXPECT_THAT(pareto_front(cost, error), ElementsAre(true, true, false, false));
}

TEST(Words, TheTableNamesWhatCannotBeRendered) {
  Measurement m;
  m.settings.resize(2);
  m.settings[1].name = "domains 8";
  m.settings[1].failure = "too little memory";
  EXPECT_THAT(table(m), testing::ContainsRegex("domains 8 +cannot be rendered here: too little memory\n"));
}

TEST(Axes, AreChosenByNameAndBecomeArguments) {
  const std::vector<Axis> axes = chosen_axes(known_axes({2}), {"depth", "clamp", "decimate"});
  ASSERT_EQ(axes.size(), 3u);
  EXPECT_EQ(name_of(axes, {0, 0, 0}), "as the scene says");
  EXPECT_EQ(name_of(axes, {1, 0, 2}), "depth none, decimate 0.1");
  EXPECT_THAT(render_arguments(axes, {1, 3, 2}), ElementsAre("--max-depth", "-1", "--clamp", "8"));
  EXPECT_THAT(partition_arguments(axes, {1, 3, 2}), ElementsAre("--decimate", "0.1"));
  EXPECT_THROW(chosen_axes(known_axes({}), {"dept"}), UsageError);
}

TEST(Axes, SayWhatTheyMayDo) {
  const std::vector<Axis> axes = chosen_axes(known_axes({}), {"roulette", "adaptivity", "filter", "domains"});
  ASSERT_EQ(axes[1].name, "adaptivity");
  EXPECT_EQ(effect_of(axes, {0, 0, 0, 0}), Effect::nothing);
  EXPECT_EQ(effect_of(axes, {0, 0, 0, 2}), Effect::nothing);
  EXPECT_EQ(effect_of(axes, {0, 1, 2, 0}), Effect::noise);
  EXPECT_EQ(effect_of(axes, {1, 1, 2, 1}), Effect::bias);
  EXPECT_EQ(least_spp(axes, {1, 0, 2, 1}), 1);
  EXPECT_EQ(least_spp(axes, {0, 1, 0, 0}), 64);
}

TEST(Plan, CountsSamplesThatSettingsTakeAtLeast) {
  MeasureOptions options;
  options.seeds = 3, options.spp = 8;
  const std::vector<Axis> plain = chosen_axes(known_axes({}), {"lights"}),
                          adaptive = chosen_axes(known_axes({}), {"adaptivity"});
  const auto wall_s = [&](const std::vector<Axis>& axes) { return make_plan(options, axes, 0.5, 0).wall_s; };
  EXPECT_DOUBLE_EQ(wall_s(adaptive) - wall_s(plain), 0.5 * 3 * (64 - 8));
}

TEST(Plan, CountsEveryRender) {
  MeasureOptions options;
  options.seeds = 3, options.spp = 8;
  const std::vector<Axis> axes = chosen_axes(known_axes({}), {"depth", "integrator", "memory"});
  const Plan one_by_one = make_plan(options, axes, 0.5, 0);
  // The reference's halves, two budgets of memory, and with each seed: the scene's own, six depths, one
  // integrator and two other counts of samples; at all three counts the pictures that biases are differences
  // to, of which those of the first are among the depths.
  EXPECT_EQ(one_by_one.renders, 2 + 2 + 3 * (1 + 6 + 1 + 2 + 3));
  EXPECT_DOUBLE_EQ(one_by_one.wall_s, 0.5 * (2 * 128 + 2 * 8 + 3 * (8 * 8 + 2 * (2 + 32))));
  EXPECT_DOUBLE_EQ(make_plan(options, {axes[1], axes[2]}, 0.5, 0).wall_s,
                   0.5 * (2 * 128 + 2 * 8 + 3 * (2 * 8 + 2 * (2 + 32) + 8)));
  EXPECT_EQ(one_by_one.search_renders, 3 * (2 * 12 + 3));
  options.every_combination = true;
  EXPECT_EQ(make_plan(options, axes, 0.5, 0).renders, 2 + 2 + 3 * (7 * 2 + 2 + 3));
  options.error = 0.1;
  EXPECT_EQ(make_plan(options, axes, 0.5, 0).search_renders, 3 * 12);
}

// A scene of two settings with these noises, and what is said of the second.
std::string said(double own_noise, double noise) {
  Measurement m;
  MeasuredSetting own;
  own.spp = 4, own.sample_s = 2, own.error.noise.value = own_noise;
  MeasuredSetting other = own;
  other.name = "depth 1", other.sample_s = 1, other.error.noise.value = noise;
  m.settings = {own, other};
  return what_it_buys(m, other);
}

TEST(Words, NoEfficiencyIsSaidOfPicturesWithoutNoise) {
  EXPECT_THAT(said(0.2, 0.1), HasSubstr("2.00 times as fast, its noise is 0.5 times as much: 4 times the"));
  for (const std::string& text : {said(0.2, 0), said(0, 0), said(0.2, -1e-9)})
    EXPECT_THAT(text, AllOf(HasSubstr("no noise is seen"), Not(HasSubstr("efficiency")))) << text;
}

}  // namespace
}  // namespace vitrail::model_test
