// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::daylight_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* paris = "48.8566,2.3522,2026-06-21T12:00+02:00";

class Daylight : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(directory_ / "scene.pbrt")
        << "LookAt 0 5 9  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40\n"
           "Film \"rgb\" \"integer xresolution\" 12 \"integer yresolution\" 8\n"
           "WorldBegin\nLightSource \"infinite\" \"float scale\" 3\n"
           "Shape \"trianglemesh\" \"point3 P\" [-4 0 -4  4 0 -4  4 0 4  -4 0 4] \"integer indices\" [0 2 1 "
           "0 3 2]\n";
    std::ofstream(directory_ / "sensors.txt")
        << "# above the ground\n0 1 0  0 1 0\nplane -1 1 1  2 0 0  0 0 -2  2x2\n";
  }
  CommandResult verb(const std::string& name, const std::string& arguments) {
    return run(fmt::format("cd '{}' && {} {}", directory_.path().string(), vitrail(name), arguments));
  }
  TemporaryDirectory directory_;
};

// docs/reference/sky.md lists each key of `sky --json`.
TEST_F(Daylight, JsonIsAsDocumented) {
  std::ifstream page(project_file("docs/reference/sky.md"));
  std::set<std::string> documented, found;
  static const std::regex key("`([a-z0-9_]+)`");
  for (std::string line; std::getline(page, line);) {
    const std::string cell = line.starts_with("| `") ? line.substr(0, line.find('|', 1)) : "";
    for (std::sregex_iterator k(cell.begin(), cell.end(), key), end; k != end; ++k)
      documented.insert((*k)[1]);
  }
  const auto json = nlohmann::json::parse(verb("sky", fmt::format("{} --json", paris)).output);
  for (const auto& [name, value] : json.items()) {
    found.insert(name);
    if (value.is_object())
      for (const auto& part : value.items()) found.insert(part.key());
  }
  EXPECT_EQ(found, documented);
}

// What it lacks is not what the user gives.
TEST_F(Daylight, AnObjWithoutALampTakesTheSkyThatIsGiven) {
  std::ofstream(directory_ / "bare.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 .2\nf 1 2 3\n";
  const CommandResult without = verb("partition", "bare.obj -o bare.vit");
  EXPECT_THAT(without.output,
              HasSubstr("there is no light: a white sky and a sun are added; --sky LATITUDE"));
  const CommandResult with = verb("partition", fmt::format("bare.obj -o bare.vit --force --sky {}", paris));
  EXPECT_EQ(with.status, 0) << with.output;
  EXPECT_THAT(with.output, Not(HasSubstr("no light")));
  EXPECT_THAT(with.output, Not(HasSubstr("infinitely far")));
}

// The printed illuminance is what a sensor in the open measures.
TEST_F(Daylight, IlluminanceIsAsPrinted) {
  const CommandResult printed = verb("sky", fmt::format("{} --json", paris));
  ASSERT_EQ(printed.status, 0) << printed.output;
  const auto json = nlohmann::json::parse(printed.output);
  EXPECT_NEAR(json["elevation_deg"], 56.31, 0.02);
  EXPECT_NEAR(json["azimuth_deg"], 128.83, 0.02);

  const CommandResult rendered =
      verb("render",
           fmt::format("scene.pbrt --sky {} --sensors sensors.txt -o out.csv --spp 1024 --quiet", paris));
  ASSERT_EQ(rendered.status, 0) << rendered.output;
  std::ifstream table(directory_ / "out.csv");
  std::string line;
  std::getline(table, line);
  EXPECT_THAT(line, HasSubstr("illuminance_lx,illuminance_error,melanopic_edi_lx"));
  int sensors = 0;
  for (; std::getline(table, line); ++sensors) {
    std::vector<double> numbers;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) numbers.push_back(std::stod(word));
    ASSERT_EQ(numbers.size(), 13u);
    EXPECT_EQ(numbers[4], 1);  // ny
    const char* names[] = {"illuminance_lx", "melanopic_edi_lx", "irradiance_w_m2"};
    for (std::size_t i = 0; i < 3; ++i) {
      const double expected = json["global_horizontal"][names[i]], found = numbers[6 + 2 * i],
                   error = numbers[7 + 2 * i];
      EXPECT_NEAR(found, expected, 5 * error + 1e-3 * expected) << names[i];
      EXPECT_LT(error, 0.02 * expected);
    }
    EXPECT_EQ(numbers[12], 1024 * 16);
  }
  EXPECT_EQ(sensors, 5);
}

// A small lamp through a ball of glass, beside its image: some seeds find it once or twice, and say so. On
// the open side the lamp is found by connections: nothing is said of that sensor.
TEST_F(Daylight, WarnsOfLightThatIsFoundSeldom) {
  std::ofstream(directory_ / "ball.pbrt") << R"(
Integrator "path" "integer maxdepth" 5
Camera "perspective"
WorldBegin
Material "diffuse" "rgb reflectance" [0 0 0]
Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [-8 -8 -.5 8 -8 -.5 0 8 -.5]
AttributeBegin
Translate 0 0 1.2
Material "dielectric" "float eta" 1.5
Shape "sphere" "float radius" .5
AttributeEnd
AreaLightSource "diffuse" "rgb L" [400 400 400]
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2] "point3 P" [-.15 -.15 3 .15 -.15 3 .15 .15 3 -.15 .15 3]
)";
  std::ofstream(directory_ / "one.txt") << "6 0 0  0 0 1\n.3 0 0  0 0 1\n";
  ASSERT_EQ(verb("partition", "ball.pbrt -o ball.vit --quiet").status, 0);
  int warned = 0;
  for (int seed = 0; seed < 8; ++seed) {
    const CommandResult done =
        verb("render", fmt::format("ball.vit --sensors one.txt -o one.csv --spp 64 --force --seed {}", seed));
    ASSERT_EQ(done.status, 0) << done.output;
    if (done.output.find("stated error") == std::string::npos) continue;
    ++warned;
    EXPECT_THAT(done.output, HasSubstr("too small at 1 of 2 sensors, first at 0.3 0 0"));
  }
  EXPECT_GE(warned, 1);
  EXPECT_LT(warned, 8);
  const CommandResult photons = verb("render",
                                     "ball.vit --sensors one.txt -o one.csv --spp 16 --force "
                                     "--integrator photon --photons 100000 --photon-radius 0.1");
  EXPECT_EQ(photons.status, 0) << photons.output;
  EXPECT_THAT(photons.output, Not(HasSubstr("stated error")));
}

TEST_F(Daylight, FalseColorsHaveAScale) {
  ASSERT_EQ(verb("render", fmt::format("scene.pbrt --sky {} -o a.film --spp 4 --quiet", paris)).status, 0);
  EXPECT_EQ(verb("develop", "a.film -o lum.png --false-color auto").status, 0);
  EXPECT_EQ(verb("develop", "a.film -o log.png --false-color 20000 --log").status, 0);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "log.png"));
  EXPECT_EQ(verb("develop", "a.film -o lum.exr --false-color auto").status, 2);
  EXPECT_EQ(verb("develop", "a.film -o lum.png --false-color none").status, 2);
  EXPECT_EQ(verb("develop", "a.film -o lum.png --log").status, 2);
  const CommandResult table = verb("develop", "a.film -o a.csv");
  EXPECT_EQ(table.status, 3);
  EXPECT_THAT(table.output, HasSubstr("render with --sensors"));
}

TEST_F(Daylight, SaysWhatIsWrong) {
  for (const char* wrong :
       {"48.9,2.3", "91,0,2026-06-21T12:00Z", "48.9,2.3,noon", "48.9,2.3,2026-06-21T12:00Z,11",
        "48.9,2.3,2026-06-21T12:00Z,haze=3", "48.9,2.3,2026-06-21T12:00Z,up=w"})
    EXPECT_EQ(verb("sky", wrong).status, 2) << wrong;
  EXPECT_EQ(verb("convert", "scene.pbrt out.pbrt --sky 48.9,2.3,2026-06-21T12:00Z,up=z,north=z").status, 2);
  const CommandResult night = verb("sky", "33.9S,70.7W,2026-06-21T00:00-04:00");
  EXPECT_EQ(night.status, 0);
  EXPECT_THAT(night.output, HasSubstr("night"));
  EXPECT_EQ(verb("render", "scene.pbrt --sensors sensors.txt -o out.png --quiet").status, 2);
  EXPECT_EQ(verb("render", "scene.pbrt --sensors sensors.txt -o out.csv --crop 0,1,0,1 --quiet").status, 2);
  EXPECT_EQ(verb("render", "scene.pbrt --sensors nothing.txt -o out.csv --quiet").status, 3);
}

// A sky is written to Mitsuba as its own, which reads back as the same; to pbrt as an image and the sun.
TEST_F(Daylight, IsConverted) {
  ASSERT_EQ(verb("convert", fmt::format("scene.pbrt out.xml --sky {},turbidity=5,north=x", paris)).status, 0);
  std::ifstream in(directory_ / "out.xml");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(text, HasSubstr("type=\"sunsky\""));
  const CommandResult again = verb("convert", "out.xml again.xml");
  ASSERT_EQ(again.status, 0) << again.output;
  std::ifstream second(directory_ / "again.xml");
  const std::string same{std::istreambuf_iterator<char>(second), {}};
  const auto sky_of = [](const std::string& xml) {
    const std::size_t at = xml.find("type=\"sunsky\"");
    return xml.substr(at, xml.find("</emitter>", at) - at);
  };
  EXPECT_EQ(sky_of(text), sky_of(same));
  ASSERT_EQ(verb("convert", "out.xml out.pbrt").status, 0);
  std::ifstream pbrt(directory_ / "out.pbrt");
  const std::string lights{std::istreambuf_iterator<char>(pbrt), {}};
  EXPECT_THAT(lights, HasSubstr("LightSource \"infinite\""));
  EXPECT_THAT(lights, HasSubstr("LightSource \"distant\""));
}

// An extension of pbrt's infinite light: its +z is up.
TEST_F(Daylight, IsALightOfPbrt) {
  const auto sky = [&](const std::string& words) {
    std::ofstream(directory_ / "sky.pbrt")
        << "WorldBegin\nRotate -90 1 0 0\nLightSource \"infinite\" \"string sky\" \"" << words
        << "\"\nShape \"sphere\"\n";
    return verb("convert", "sky.pbrt sky.xml");
  };
  EXPECT_EQ(sky(paris).status, 0);
  std::ifstream in(directory_ / "sky.xml");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(text, HasSubstr("type=\"sunsky\""));
  const CommandResult wrong = sky("nowhere");
  EXPECT_EQ(wrong.status, 3);
  EXPECT_THAT(wrong.output, HasSubstr("sky.pbrt:3"));
}

}  // namespace
}  // namespace vitrail::test::daylight_test
