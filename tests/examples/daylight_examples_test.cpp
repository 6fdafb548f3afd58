// SPDX-License-Identifier: Apache-2.0
// The examples of daylight and of light through glass: they make what their READMEs say.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "images/image_files.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::daylight_examples_test {
namespace {

std::vector<std::vector<std::string>> table(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    rows.emplace_back();
    for (std::string word; std::getline(words, word, ',');) rows.back().push_back(word);
  }
  return rows;
}

// Glass that is dark when it dazzles lets less heat in than clear glass, and no glass lets all of it in.
TEST(HotelRoom, OverAYear) {
  const TemporaryDirectory directory;
  const std::string front = vitrail("");
  const CommandResult made = run(fmt::format(
      "cd '{0}' && /usr/bin/python3 '{1}/examples/frames/made_up_weather.py' --place 48.86,2.35 --zone 1 > "
      "w.epw && "
      "/usr/bin/python3 '{1}/examples/hotel-room/year.py' -o year --weather w.epw --quick --vitrail {2}",
      directory.path().string(), source_dir(), front.substr(0, front.find_last_not_of(' ') + 1)));
  ASSERT_EQ(made.status, 0) << made.output;
  std::map<std::string, double> heat, glare;
  std::ifstream in(directory / "year" / "year.md");
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, '|');) row.push_back(cell);
    ASSERT_EQ(row.size(), 7u) << line;
    if (row[4].find("±") == std::string::npos) continue;
    heat[row[1]] = std::stod(row[6]), glare[row[1]] = std::stod(row[4]);
  }
  ASSERT_EQ(heat.size(), 3u);
  EXPECT_LT(heat[" electrochromic "], heat[" clear "]);
  EXPECT_LT(heat[" photochromic "], heat[" clear "]);
  EXPECT_LT(glare[" electrochromic "], glare[" clear "]);
  double on_the_pane = 0, let_in = 0;
  for (const auto& row : table(directory / "year" / "photochromic" / "heat.csv"))
    if (row[0] != "month") on_the_pane += std::stod(row[4]), let_in += std::stod(row[5]);
  EXPECT_GT(let_in / on_the_pane, 0.25);
  EXPECT_LT(let_in / on_the_pane, 0.753);  // the SHGC of the clear state at the normal
}

// The states see the same paths, so that the light differs as the glass does: T_vis 0.787 and 0.114.
TEST(HotelRoom, OverADay) {
  const TemporaryDirectory directory;
  const auto day = directory / "day";
  const std::string front = vitrail("");
  const CommandResult made = run(
      fmt::format("/usr/bin/python3 '{}/examples/hotel-room/day.py' -o '{}' --vitrail {} --width 32 --spp 2 "
                  "--hours 8 13 --measured 13 --states 0 1 --sensor-spp 64",
                  source_dir(), day.string(), front.substr(0, front.find_last_not_of(' ') + 1)));
  ASSERT_EQ(made.status, 0) << made.output;

  std::map<std::string, double> light;
  for (const auto& row : table(day / "light.csv"))
    if (row[0] != "hour") light[row[1] + " " + row[2]] = std::stod(row[9]);
  ASSERT_EQ(light.size(), 4u);
  for (const std::string sensor : {"on the desk", "at the eye"}) {
    EXPECT_GT(light["1 " + sensor], 10) << sensor;
    EXPECT_NEAR(light["1 " + sensor] / light["0 " + sensor], 0.114 / 0.787, 0.05) << sensor;
  }
  std::ifstream plot(day / "light.svg");
  const std::string svg{std::istreambuf_iterator<char>(plot), {}};
  EXPECT_THAT(svg, testing::HasSubstr("<polyline"));

  const Image sheet = read_stored_image(day / "day.png").image;
  ASSERT_EQ(sheet.width, 2 * 32 + 4);
  ASSERT_EQ(sheet.height, 2 * 18 + 4);
  int row = 0;
  for (const char* state : {"0", "1"}) {
    int column = 0;
    for (const char* hour : {"0800", "1300"}) {
      const Image picture = read_stored_image(day / fmt::format("{}-{}.png", hour, state)).image;
      int unlike = 0;
      for (int y = 0; y < 18; ++y)
        for (int i = 0; i < 3 * 32; ++i)
          unlike += picture.values[static_cast<std::size_t>(y * 96 + i)] !=
                    sheet.values[static_cast<std::size_t>((y + row) * 204 + 3 * column + i)];
      EXPECT_EQ(unlike, 0) << hour << ' ' << state;
      column += 36;
    }
    row += 22;
  }
}

// What is in the shadow of the glass comes through it: photons bring it, and hardly anything is left without.
TEST(Caustic, IsOfPhotons) {
  const TemporaryDirectory directory;
  const CommandResult made =
      run(fmt::format("/usr/bin/python3 '{}/examples/caustic/generate.py' -o '{}' --light lamp --detail 0.25 "
                      "--width 32",
                      source_dir(), directory.path().string()));
  ASSERT_EQ(made.status, 0) << made.output;
  const auto in_the_shadow = [&](const std::string& options) {
    const std::string scene = (directory / "caustic.pbrt").string(), picture = (directory / "c.exr").string();
    const CommandResult rendered = run(fmt::format("{} '{}' -o '{}' --force --quiet --spp 8 --threads 2 {}",
                                                   vitrail("render"), scene, picture, options));
    EXPECT_EQ(rendered.status, 0) << rendered.output;
    const Image image = read_stored_image(picture).image;
    const auto channels = image.values.size() / static_cast<std::size_t>(image.width * image.height);
    double sum = 0;
    for (int y = 17; y < 19; ++y)
      for (int x = 18; x < 26; ++x)
        sum += static_cast<double>(image.values[static_cast<std::size_t>(y * image.width + x) * channels]);
    return sum / 16;
  };
  const double photons = in_the_shadow("--integrator photon --photons 50000 --photon-radius 0.006"),
               paths = in_the_shadow("--integrator path");
  fmt::print("in the shadow: {:.4f} by photons, {:.4f} by paths\n", photons, paths);
  EXPECT_GT(photons, 5 * paths);
  EXPECT_GT(photons, 0.05);
}

}  // namespace
}  // namespace vitrail::test::daylight_examples_test
