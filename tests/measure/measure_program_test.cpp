// SPDX-License-Identifier: Apache-2.0
// vitrail measure as a user runs it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::measure_program_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class MeasureProgram : public testing::Test {
 protected:
  // A lamp over a floor and beside a wall: indirect light is a good part of it.
  MeasureProgram() {
    std::ofstream(directory_ / "scene.pbrt") << R"(
LookAt 0 1 4  0 1 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 64 "integer yresolution" 64
Sampler "independent" "integer pixelsamples" 32
Integrator "path" "integer maxdepth" 6
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [4 4 4]
  Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-.5 1.9 -.5  .5 1.9 -.5  .5 1.9 .5  -.5 1.9 .5]
AttributeEnd
Material "diffuse" "rgb reflectance" [.8 .8 .8]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 0 -1  1 0 -1  1 0 1  -1 0 1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 0 -1  1 0 -1  1 2 -1  -1 2 -1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 0 -1  -1 0 1  -1 2 1  -1 2 -1]
)";
  }
  CommandResult measure(const std::string& more) {
    return run(fmt::format("{} '{}' -o '{}' --width 32 --seeds 3 --spp 4 --reference-spp 64 {}",
                           vitrail("measure"), (directory_ / "scene.pbrt").string(),
                           (directory_ / "out").string(), more));
  }
  TemporaryDirectory directory_;
};

TEST_F(MeasureProgram, SaysWhatEachSettingBuysAndResumes) {
  const std::string options = "--axes depth,roulette,domains --error 0.01 --ranks 4 --threads 1";
  const CommandResult first = measure(options);
  ASSERT_EQ(first.status, 0) << first.output;
  EXPECT_THAT(first.output, AllOf(HasSubstr("a reference of 2 × 64"), HasSubstr("depth 1"),
                                  HasSubstr("darker"), HasSubstr("For a relMSE of 0.01: render --spp")));
  const nlohmann::json json = read_json(directory_ / "out" / "measure.json");
  EXPECT_GT(json.at("reference_relmse").get<double>(), 0);
  bool direct_is_biased = false, domains_show = true;
  for (const auto& s : json.at("settings")) {
    if (s.at("name") == "depth 1") direct_is_biased = s.at("biased").get<bool>();
    if (s.at("name").get<std::string>().starts_with("domains")) domains_show = !s.at("identical").get<bool>();
  }
  EXPECT_TRUE(direct_is_biased);
  // On four cores it takes a little more than a quarter of the CPU seconds.
  const nlohmann::json& own = json.at("settings").at(0);
  const double work_s = own.at("cpu_s_per_sample").get<double>() * json.at("full_size").get<double>();
  EXPECT_NEAR(own.at("farm_s_per_sample").get<double>(), work_s / 4, 0.2 * work_s / 4);
  EXPECT_GT(json.at("recommendations").at(0).at("farm_s").get<double>(), 0);
  EXPECT_FALSE(domains_show);

  std::ifstream in(directory_ / "out" / "index.html");
  const std::string page(std::istreambuf_iterator<char>(in), {});
  EXPECT_THAT(page, AllOf(HasSubstr("data:image/png;base64,"), HasSubstr("</html>"), Not(HasSubstr("http")),
                          Not(HasSubstr("@DATA@"))));

  // All is there: nothing is rendered again, and the numbers are the same.
  const auto renders = [&] {
    return std::distance(std::filesystem::directory_iterator(directory_ / "out" / "runs"), {});
  };
  const auto before = renders();
  ASSERT_EQ(measure(options).status, 0);
  EXPECT_EQ(renders(), before);
  EXPECT_EQ(read_json(directory_ / "out" / "measure.json"), json);
}

// A white room whose dim lamp shines at the ceiling: all that the camera sees was scattered at least twice.
// Direct light is black, quick and without noise, and off by a relMSE of .009 alone.
TEST_F(MeasureProgram, DoesNotRecommendTheDark) {
  const auto wall = [](const char* points) {
    return fmt::format("Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [{}]\n",
                       points);
  };
  std::ofstream out(directory_ / "scene.pbrt");
  out << "LookAt 0 1 .9  0 .7 0  0 1 0\nCamera \"perspective\" \"float fov\" 70\n"
         "Film \"rgb\" \"integer xresolution\" 32 \"integer yresolution\" 32\n"
         "Integrator \"path\" \"integer maxdepth\" 100\nWorldBegin\nAttributeBegin\n"
         "AreaLightSource \"diffuse\" \"rgb L\" [.2 .2 .2]\n"
      << wall("-.2 1.6 -.2  -.2 1.6 .2  .2 1.6 .2  .2 1.6 -.2")
      << "AttributeEnd\nMaterial \"diffuse\" \"rgb reflectance\" [.9 .9 .9]\n";
  for (const char* points : {"-1 0 -1  1 0 -1  1 0 1  -1 0 1", "-1 2 -1  1 2 -1  1 2 1  -1 2 1",
                             "-1 0 -1  1 0 -1  1 2 -1  -1 2 -1", "-1 0 1  1 0 1  1 2 1  -1 2 1",
                             "-1 0 -1  -1 0 1  -1 2 1  -1 2 -1", "1 0 -1  1 0 1  1 2 1  1 2 -1"})
    out << wall(points);
  out.close();
  const CommandResult done = measure("--axes depth,integrator --error 0.0098 --ranks 0");
  ASSERT_EQ(done.status, 0) << done.output;
  const nlohmann::json best = read_json(directory_ / "out" / "measure.json").at("recommendations").at(0);
  ASSERT_TRUE(best.at("found").get<bool>()) << done.output;
  EXPECT_NEAR(best.at("luminance_off").at("value").get<double>(), 0, 0.01) << best.dump(1);
  EXPECT_EQ(best.at("rendered_spp"), best.at("spp"));
  EXPECT_THAT(done.output, HasSubstr("settings that may bias the picture"));
}

TEST_F(MeasureProgram, RefusesWhatItDoesNotKnow) {
  const CommandResult axis = measure("--axes roulete");
  EXPECT_EQ(axis.status, 2);
  EXPECT_THAT(axis.output, HasSubstr("there are depth, clamp"));
  EXPECT_EQ(run(vitrail("measure") + " no.pbrt -o out").status, 3);
}

TEST_F(MeasureProgram, LeavesThePagesOfOthersAlone) {
  std::filesystem::create_directory(directory_ / "out");
  std::ofstream(directory_ / "out" / "index.html") << "mine";
  const CommandResult refused = measure("--axes integrator");
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.output, HasSubstr("name another folder"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out" / "runs"));
}

}  // namespace
}  // namespace vitrail::test::measure_program_test
