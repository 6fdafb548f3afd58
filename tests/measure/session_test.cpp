// SPDX-License-Identifier: Apache-2.0
// Which renders a setting takes and what becomes of those that fail, with programs that only pretend.
#include "measure/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "film/film_progress.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::session_test {
namespace {

using Words = std::vector<std::string>;

bool has(const Words& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

const std::string& after(const Words& words, const std::string& option) {
  return *std::next(std::ranges::find(words, option));
}

class SessionTest : public testing::Test {
 protected:
  SessionTest() {
    std::ofstream(directory_ / "scene.pbrt") << "never read";
    options_.seeds = 3;
  }
  // With one axis, of those that there are.
  MeasuredSetting measured(const std::string& axis, const Setting& setting) {
    measurement_.axes = chosen_axes(known_axes({}), {axis});
    return session_.measure_setting(measurement_, setting, 4);
  }

  // As bright as the seed's number, times what is given; the reference is as bright as their mean.
  static void write_picture_of(const Words& words, double times) {
    const std::uint64_t seed = std::stoull(after(words, "--seed"));
    FilmSettings settings;
    settings.width = settings.height = 16;
    settings.crop = {0, 16, 0, 16};
    Film film(settings, {1, seed, 5});
    for (std::uint32_t p = 0; p < 256; ++p) {
      film.count_sample(p, 0);
      const double v = times * static_cast<double>(seed <= 3 ? seed : 2);
      film.deposit(p, 0, srgb_to_xyz(RGB{v, v, v}));
    }
    write_film(after(words, "-o"), film, {1, 1, {1}, 1});
    std::ofstream(after(words, "--stats")) << R"({"wall_s": 2, "rays_camera": 3, "rays_shadow": 4})";
    if (has(words, "--profile")) std::ofstream(after(words, "--profile")) << "{}";
  }

  TemporaryDirectory directory_;
  MeasureOptions options_;
  std::function<void(const Words&)> render_;
  Runs runs_{directory_ / "scene.pbrt", directory_ / "out", 32,
             [this](const std::string& program, const Words& words, const std::filesystem::path&) {
               if (program == "vitrail-render") return render_(words);
               std::filesystem::create_directories(after(words, "-o") + "/domains");
               std::ofstream(after(words, "-o") + "/domains/000000.dom") << "12345";
             }};
  MeasureNews news_{[](const std::string&) {}, [](double, const char*) {}};
  Session session_{runs_, options_, 4, 10, news_};
  Measurement measurement_;
};

TEST_F(SessionTest, OnlyScarceMemoryMayFail) {
  render_ = [](const Words&) { throw MachineError("no room"); };
  EXPECT_EQ(measured("memory", {1}).failure, "no room");
  EXPECT_THROW(measured("integrator", {1}), MachineError);
  EXPECT_THROW(measured("memory", {0}), MachineError);
  render_ = [](const Words&) { throw Error("refused"); };
  EXPECT_EQ(measured("integrator", {1}).failure, "refused");
}

// Roulette cannot have a bias: what there is of it is the scene's own. Adaptivity takes its least samples.
TEST_F(SessionTest, NoiseHasNoBiasAndTakesItsSamples) {
  std::vector<std::string> spp;
  render_ = [&](const Words& words) {
    spp.push_back(after(words, "--spp"));
    write_picture_of(words, has(words, "early") ? 9 : 1);
  };
  measurement_.reference = session_.reference(4);
  measurement_.settings.push_back(measured("roulette", {0}));
  const MeasuredSetting early = measured("roulette", {1}), clamped = measured("clamp", {1});
  EXPECT_EQ(early.effect, Effect::noise);
  for (const float v : early.mean.values) EXPECT_NEAR(v, 18, 0.01) << "of seeds that are 9, 18 and 27";
  EXPECT_EQ(early.error.bias.value, measurement_.settings[0].error.bias.value);
  // Nine times as far apart. The scene's own, which is known to have no bias, has two thirds of the variance
  // that three pictures tell of.
  EXPECT_NEAR(early.error.noise.value, 81 * 1.5 * measurement_.settings[0].error.noise.value,
              0.001 * early.error.noise.value);
  EXPECT_EQ(clamped.effect, Effect::bias);
  spp.clear();
  EXPECT_EQ(measured("adaptivity", {1}).spp, 64);
  EXPECT_EQ(spp, (std::vector<std::string>{"64", "64", "64"}));
}

TEST_F(SessionTest, RunsSayWhatTheyTookWhenTheyAreReadAgain) {
  render_ = [](const Words& words) { write_picture_of(words, 1); };
  const RunRequest request{.render = {"--quick"}, .spp = 4, .seed = 2};
  for (const char* from : {"the program", "its file"}) {
    const RunResult result = runs_(request);
    EXPECT_EQ(result.wall_s, 2) << from;
    EXPECT_EQ(result.rays, 7) << from;
    EXPECT_EQ(result.bundle_bytes, 5) << from;
    EXPECT_NEAR(result.picture.values.at(0), 2, 0.01) << from;
    render_ = [](const Words&) { ADD_FAILURE() << "it is known"; };
  }
  for (const auto& file : std::filesystem::directory_iterator(directory_ / "out/runs"))
    EXPECT_TRUE(file.path().extension() == ".json" || file.path().extension() == ".rgb") << file.path();
}

TEST_F(SessionTest, SettingsAreIdenticalWhereAllSeedsAre) {
  // The clamp of choice 1 meets no seed, that of choice 2 the third.
  const Words third = known_axes({})[1].choices[2].render;
  render_ = [&](const Words& words) {
    const std::uint64_t seed = std::stoull(after(words, "--seed"));
    const bool is_clamped = has(words, "--clamp") && after(words, "--clamp") == third[1] && seed == 3;
    write_picture_of(words, is_clamped ? 0.5 / static_cast<double>(seed) : 1);
  };
  measurement_.reference = session_.reference(4);
  measurement_.settings.push_back(measured("clamp", {0}));
  EXPECT_TRUE(measured("clamp", {1}).identical);
  EXPECT_FALSE(measured("clamp", {2}).identical);
}

}  // namespace
}  // namespace vitrail::test::session_test
