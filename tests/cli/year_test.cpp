// SPDX-License-Identifier: Apache-2.0
// A year of daylight as somebody types it: against Radiance, and what happens where something is wrong.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::year_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using Table = std::vector<std::vector<std::string>>;

Table table(const std::filesystem::path& file) {
  Table rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    rows.emplace_back();
    for (std::string word; std::getline(words, word, ',');) rows.back().push_back(word);
  }
  return rows;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class Year : public ::testing::Test {
 protected:
  // A plane without walls, of which z is up; the weather of two days.
  void SetUp() override {
    std::ofstream(directory_ / "open.pbrt")
        << "LookAt 0 -9 5  0 0 0  0 0 1\nCamera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n"
           "Shape \"trianglemesh\" \"point3 P\" [-1 -1 -9  1 -1 -9  1 1 -9  -1 1 -9] \"integer indices\" [0 "
           "1 2 "
           "0 2 3]\n";
    std::ofstream(directory_ / "up.txt") << "0 0 0  0 0 1\n0 0 0  0 -1 0\n";
    std::ofstream weather(directory_ / "w.epw");
    weather << "LOCATION,Own,-,-,own,0,48.86,2.35,1.0,40\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n";
    for (const int day : {21, 22})
      for (int hour = 1; hour <= 24; ++hour) {
        const bool is_light = hour > 7 && hour < 18;
        weather << fmt::format("2001,3,{},{},60,?,1,1,70,101325,0,0,300,0,{},{},1\n", day, hour,
                               is_light && day == 21 ? 600 : 0, is_light ? 120 : 0);
      }
    weather.close();
    const CommandResult made = verb("partition", "open.pbrt -o open.vit");
    ASSERT_EQ(made.status, 0) << made.output;
  }
  CommandResult verb(const std::string& name, const std::string& arguments) {
    return run(fmt::format("cd '{}' && {} {}", directory_.path().string(), vitrail(name), arguments));
  }
  CommandResult year(const std::string& more = "", const std::string& output = "year") {
    return verb("year", fmt::format("open.vit --weather w.epw --sensors up.txt -o {} --patches 1 --paths 2k "
                                    "--sun-paths 4 --quiet {}",
                                    output, more));
  }
  TemporaryDirectory directory_;
};

// What a sensor in the open has is what the hour has outdoors.
TEST_F(Year, IsTheWeatherInTheOpen) {
  const CommandResult done = year();
  ASSERT_EQ(done.status, 0) << done.output;
  const Table hours = table(directory_ / "year" / "hours.csv");
  ASSERT_EQ(hours.size(), 49u);
  int days = 0;
  for (std::size_t h = 1; h < hours.size(); ++h) {
    const double global = std::stod(hours[h][7]), lux = std::stod(hours[h][9]);
    EXPECT_NEAR(lux, global, 0.01 * global) << h;
    days += lux > 0;
  }
  // Sky and sun are D65, whose melanopic EDI is its lux.
  const Table melanopic = table(directory_ / "year" / "hours-melanopic.csv");
  double all_melanopic = 0, all_lux = 0;
  for (std::size_t h = 1; h < hours.size(); ++h) {
    EXPECT_NEAR(std::stod(melanopic[h][9]), std::stod(hours[h][9]), 0.04 * std::stod(hours[h][9])) << h;
    all_melanopic += std::stod(melanopic[h][9]), all_lux += std::stod(hours[h][9]);
  }
  EXPECT_NEAR(all_melanopic / all_lux, 1, 0.005);
  EXPECT_EQ(days, 20);
  EXPECT_THAT(done.output, HasSubstr("sDA 300,50% without blinds"));
  const Table figures = table(directory_ / "year" / "figures.csv");
  ASSERT_EQ(figures.size(), 3u);
  EXPECT_EQ(figures[1][7], "1");  // in the area
  EXPECT_EQ(figures[2][7], "0");
  EXPECT_NEAR(std::stod(figures[1][10]), 0.9, 0.001);  // DA: from 17 h on it is dark
  EXPECT_THAT(text_of(directory_ / "year" / "index.html"), HasSubstr("Daylight provision (EN 17037"));
}

TEST_F(Year, GoesOnFromWhatIsThere) {
  ASSERT_EQ(year().status, 0);
  const std::string before = text_of(directory_ / "year" / "hours.csv");
  const auto film = directory_ / "year" / "as-it-is.sky.film";
  const auto written = std::filesystem::last_write_time(film);
  ASSERT_EQ(year("--use 0-24").status, 0);
  EXPECT_EQ(std::filesystem::last_write_time(film), written);  // nothing was traced again
  EXPECT_EQ(text_of(directory_ / "year" / "hours.csv"), before);
  std::ofstream(directory_ / "up.txt") << "0 0 1  0 0 1\n";
  const CommandResult other = year();
  EXPECT_EQ(other.status, 3) << other.output;
  EXPECT_THAT(other.output, HasSubstr("of other sensors"));
  EXPECT_EQ(text_of(directory_ / "year" / "hours.csv"), before);
  EXPECT_EQ(year("--force").status, 0);
  // Another day's sunlight, and the same weather under another name, trace no hour again.
  std::filesystem::copy_file(directory_ / "w.epw", directory_ / "same.epw");
  EXPECT_EQ(year("--sun-day 02-01 --weather same.epw").status, 0);
  std::ofstream(directory_ / "same.epw", std::ios::app)
      << "2001,3,23,12,60,?,1,1,70,101325,0,0,300,0,500,100,1\n";
  const CommandResult weather = year("--weather same.epw");
  EXPECT_EQ(weather.status, 3) << weather.output;
  EXPECT_THAT(weather.output, HasSubstr("its weather was same.epw"));
  EXPECT_THAT(year("--weather same.epw --force").output, HasSubstr("49 hours are no year"));
}

// Ranks, threads and sub-domains: one matrix, to the bit.
TEST_F(Year, IsTheSameOnRanks) {
  ASSERT_EQ(year("--threads 1").status, 0);
  const CommandResult ranks = run(
      fmt::format("cd '{}' && {} open.vit --weather w.epw --sensors up.txt -o ranks --patches 1 --paths 2k "
                  "--sun-paths 4 --quiet",
                  directory_.path().string(), mpi_vitrail("year", 2)));
  ASSERT_EQ(ranks.status, 0) << ranks.output;
  for (const char* file : {"as-it-is.sky.npy", "as-it-is.sun.npy", "as-it-is.beam-error.npy", "hours.csv"})
    EXPECT_EQ(text_of(directory_ / "year" / file), text_of(directory_ / "ranks" / file)) << file;
}

// What was traced is kept; under the final names nothing is half written.
TEST_F(Year, StopsAndGoesOn) {
  const std::string line = fmt::format(
      "{} open.vit --weather w.epw --sensors up.txt -o year --paths 4M --sun-paths 4 --quiet "
      "--checkpoint-every 0.1",
      vitrail("year"));
  const CommandResult stopped = run(
      fmt::format("cd '{}' && ({} & it=$!; until [ -e year/as-it-is.sky.film.partial ]; do sleep .02; done; "
                  "kill -TERM $it; wait $it)",
                  directory_.path().string(), line));
  EXPECT_EQ(stopped.status, 143) << stopped.output;
  EXPECT_THAT(stopped.output, HasSubstr("the same command continues"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "year" / "hours.csv"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "year" / "as-it-is.sky.film"));
  const CommandResult done = run(fmt::format("cd '{}' && {}", directory_.path().string(), line));
  EXPECT_EQ(done.status, 0) << done.output;
  EXPECT_TRUE(std::filesystem::exists(directory_ / "year" / "hours.csv"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "year" / "as-it-is.sky.film.partial"));
}

TEST_F(Year, StatesFollowRules) {
  // The states differ by nothing that is seen in the open, so their names tell.
  std::ofstream(directory_ / "rules.json") << R"({"rules": [{"when": "sensor 1 > 50000 lx", "state": "dark"},
                       {"when": "hour >= 22 and month < 4", "state": "night"}], "otherwise": "clear"})";
  const CommandResult done = year("--state night= --state clear= --state dark= --rules rules.json");
  ASSERT_EQ(done.status, 0) << done.output;
  const Table hours = table(directory_ / "year" / "hours.csv");
  std::set<std::string> seen;
  for (std::size_t h = 1; h < hours.size(); ++h) {
    const bool bright = std::stod(hours[h][9]) > 50000, late = std::stoi(hours[h][2]) >= 22;
    EXPECT_EQ(hours[h][8], bright ? "dark" : late ? "night" : "clear") << h;
    seen.insert(hours[h][8]);
  }
  EXPECT_EQ(seen.size(), 3u);
}

// A room in which blinds are closed is another bundle: here a sheet above the sensors. By the sheet nothing
// comes through, but for what comes from the side below it.
TEST_F(Year, BlindsCloseByTheRuleOfLm83) {
  std::ofstream(directory_ / "closed.pbrt")
      << "LookAt 0 -9 5  0 0 0  0 0 1\nCamera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n"
         "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n"
         "Shape \"trianglemesh\" \"point3 P\" [-1e4 -1e4 1  1e4 -1e4 1  1e4 1e4 1  -1e4 1e4 1] \"integer "
         "indices\" [0 1 2 0 2 3]\n";
  ASSERT_EQ(verb("partition", "closed.pbrt -o closed.vit").status, 0);
  const CommandResult done = year("--state open= --state closed=closed.vit --blinds closed");
  ASSERT_EQ(done.status, 0) << done.output;
  EXPECT_THAT(done.output, HasSubstr("sDA 300,50% "));
  EXPECT_THAT(done.output, Not(HasSubstr("without blinds")));
  const Table hours = table(directory_ / "year" / "hours.csv");
  int closed = 0;
  for (std::size_t h = 1; h < hours.size(); ++h) {
    const double on_the_ground = std::stod(hours[h][5]) * std::sin(std::stod(hours[h][3]) * 3.14159265 / 180);
    EXPECT_EQ(hours[h][8], on_the_ground > 1000 ? "closed" : "open") << h;
    if (hours[h][8] != "closed") continue;
    ++closed;
    EXPECT_LT(std::stod(hours[h][9]), 1) << h;
  }
  EXPECT_GT(closed, 5);
}

// A black room of 4 × 4 × 3 with a window to the east and one to the west, from 1 to 2. A closed one is wall.
TEST_F(Year, EachGroupOfWindowsClosesByItself) {
  const auto room = [&](const std::string& name, bool east, bool west) {
    std::ofstream out(directory_ / (name + ".pbrt"));
    out << "LookAt 0 -9 5  0 0 0  0 0 1\nCamera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n"
           "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n";
    const auto wall = [&](const std::string& points) {
      out << "Shape \"trianglemesh\" \"point3 P\" [" << points << "] \"integer indices\" [0 1 2 0 2 3]\n";
    };
    for (const double z : {-0.1, 3.0}) wall(fmt::format("-2 -2 {0}  2 -2 {0}  2 2 {0}  -2 2 {0}", z));
    for (const double y : {-2.0, 2.0}) wall(fmt::format("-2 {0} -0.1  2 {0} -0.1  2 {0} 3  -2 {0} 3", y));
    for (const bool is_east : {true, false}) {
      const auto strip = [&](double low, double high) {
        wall(fmt::format("{0} -2 {1}  {0} 2 {1}  {0} 2 {2}  {0} -2 {2}", is_east ? 2 : -2, low, high));
      };
      strip(-0.1, 1), strip(2, 3);
      if (is_east ? !east : !west) strip(1, 2);
    }
    out.close();
    EXPECT_EQ(verb("partition", fmt::format("{0}.pbrt -o {0}.vit", name)).status, 0);
  };
  room("room", true, true), room("no-east", false, true), room("no-west", true, false);
  std::ofstream grid(directory_ / "grid.txt");
  for (int i = 0; i < 25; ++i)
    grid << fmt::format("{} {} 0.01  0 0 1\n", -1.6 + i % 5 * 0.8, -1.6 + i / 5 * 0.8);
  grid.close();
  const CommandResult done =
      verb("year",
           "room.vit --weather w.epw --sensors grid.txt -o rooms --patches 1 --paths 2k --sun-paths 2 "
           "--quiet --state open= --state east=no-east.vit --state west=no-west.vit --blinds east "
           "--blinds west");
  ASSERT_EQ(done.status, 0) << done.output;
  const Table hours = table(directory_ / "rooms" / "hours.csv");
  std::set<std::string> seen;
  for (std::size_t h = 1; h < hours.size(); ++h) {
    const double degree = 3.14159265 / 180, elevation = std::stod(hours[h][3]) * degree,
                 azimuth = std::stod(hours[h][4]) * degree, direct = std::stod(hours[h][5]);
    const double x = std::sin(azimuth) * std::cos(elevation), y = std::cos(azimuth) * std::cos(elevation),
                 z = std::sin(elevation);
    // Whether a sensor sees the sun through a window that is larger by `more`.
    const auto asks = [&](double more) {
      bool any = false;
      for (int i = 0; i < 25; ++i) {
        const double sx = -1.6 + i % 5 * 0.8, sy = -1.6 + i / 5 * 0.8;
        const double way = ((x > 0 ? 2 : -2) - sx) / x;
        any |= std::abs(sy + way * y) < 2 + more && std::abs(0.01 + way * z - 1.5) < 0.5 + more;
      }
      return any && direct * z > 1000;
    };
    if (direct > 0 && asks(0.05) != asks(-0.05)) continue;  // at an edge
    const std::string expected = direct <= 0 || !asks(0) ? "open" : x > 0 ? "east" : "west";
    EXPECT_EQ(hours[h][8], expected) << h;
    if (direct > 0) seen.insert(expected);
    // No sun is left, and no more sky than the windows' share of it.
    for (std::size_t s = 0; s < 25 && expected != "open"; ++s)
      EXPECT_LT(std::stod(hours[h][9 + s]), 5000) << h;
  }
  EXPECT_EQ(seen, (std::set<std::string>{"east", "open", "west"}));
}

// The file's own lux, where it has them.
TEST_F(Year, TakesTheLuxOfTheFile) {
  std::ofstream weather(directory_ / "lux.epw");
  weather << "LOCATION,Own,-,-,own,0,48.86,2.35,1.0,40\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n";
  for (const char* lux : {"90000,60000,30000", "999999,999999,999999"})
    weather << fmt::format("2001,3,{},13,60,?,1,1,70,101325,0,0,300,0,600,120,{},9999\n",
                           lux[0] == '9' && lux[1] == '0' ? 21 : 22, lux);
  weather.close();
  const CommandResult done = year("--weather lux.epw --file-lux", "own"),
                      perez = year("--weather lux.epw", "perez");
  ASSERT_EQ(done.status, 0) << done.output;
  EXPECT_THAT(done.output, HasSubstr("1 hours have no illuminances"));
  const Table own = table(directory_ / "own" / "hours.csv"),
              by_perez = table(directory_ / "perez" / "hours.csv");
  EXPECT_EQ(std::stod(own[1][5]), 60000);
  EXPECT_EQ(std::stod(own[1][6]), 30000);
  EXPECT_NEAR(std::stod(own[1][9]), std::stod(own[1][7]), 0.01 * std::stod(own[1][7]));
  EXPECT_NE(own[1], by_perez[1]);
  EXPECT_EQ(own[2][5], by_perez[2][5]);
  EXPECT_EQ(own[2][6], by_perez[2][6]);
}

// The sensor that looks south on the equinox has the sun from 6 to 18 h of the sun's time: above 10° that is
// while the sine of its height, which is that of the noon times the cosine of its hour, is more than that of
// 10°.
TEST_F(Year, SunlightIsThatOfTheDay) {
  const CommandResult done = year();
  ASSERT_EQ(done.status, 0) << done.output;
  const double half_deg =
      std::acos(std::sin(10 * 3.14159265 / 180) / std::cos(48.86 * 3.14159265 / 180)) * 180 / 3.14159265;
  const Table sunlight = table(directory_ / "year" / "sunlight.csv");
  ASSERT_EQ(sunlight.size(), 2u);  // the sensor that looks up is not among them
  EXPECT_EQ(sunlight[1][0], "2");
  EXPECT_NEAR(std::stod(sunlight[1][7]), 2 * half_deg / 15, 0.1);
  EXPECT_EQ(sunlight[1][8], "high");
  EXPECT_THAT(done.output, HasSubstr("EN 17037 sunlight on 03-21"));
  // The overcast sky, too, is seen whole.
  const Table figures = table(directory_ / "year" / "figures.csv");
  const auto column = std::ranges::find(figures[0], "daylight_factor") - figures[0].begin();
  EXPECT_NEAR(std::stod(figures[1][static_cast<std::size_t>(column)]), 1, 0.01);
}

TEST_F(Year, MistakesAreNamed) {
  EXPECT_EQ(year("--use 18-8").status, 2);
  EXPECT_EQ(year("--patches 3").status, 2);
  EXPECT_EQ(year("--sun-day 02-30").status, 2);
  EXPECT_EQ(year("--heat window=panes.json@3").status, 2);  // there are two sensors
  EXPECT_EQ(year("--photochromic").status, 2);
  EXPECT_EQ(year("--state a= --state b= --blinds c").status, 2);
  EXPECT_EQ(year("--state a= --state b= --blinds b --blinds b").status, 2);
  EXPECT_EQ(year("--state a= --state b= --state c= --blinds b --blinds c --rules rules.json").status, 2);
  EXPECT_EQ(year("--state clear=window.state=1").status, 2);  // the scene has no such glass
  EXPECT_EQ(year("--rules rules.json").status, 2);
  EXPECT_EQ(year("--up z --north -z").status, 2);
  std::ofstream(directory_ / "rules.json") << R"({"rules": [{"when": "sensor 9 > 1 lx", "state": "a"}]})";
  const CommandResult rules = year("--state a= --state b= --rules rules.json");
  EXPECT_EQ(rules.status, 3);
  EXPECT_THAT(rules.output, HasSubstr("sensors are numbered from 1 to 2"));
  std::ofstream(directory_ / "w.epw") << "no weather\n";
  const CommandResult weather = year();
  EXPECT_EQ(weather.status, 3);
  EXPECT_THAT(weather.output, HasSubstr("w.epw:1"));
  EXPECT_EQ(verb("year", "none.vit --weather w.epw --sensors up.txt -o year").status, 3);
}

// Of the corpus' room, whose numbers are those of rfluxmtx, gendaymtx -m 4 and dctimestep: overcast hours
// sensor by sensor. In hours of sun Radiance's have up to 40 % of noise, and spread the sun over three
// patches: there it is the sum at the back on a day in March, when no sun gets that far.
TEST_F(Year, IsAsRadianceHasIt) {
  const auto room = corpus() / "daylight";
  if (!std::filesystem::exists(room / "three-days-expected.csv")) GTEST_SKIP() << "no corpus";
  ASSERT_EQ(verb("partition", fmt::format("'{}' -o room.vit", (room / "room.pbrt").string())).status, 0);
  const CommandResult done =
      verb("year", fmt::format("room.vit --weather '{0}/three-days.epw' --sensors '{0}/sensors.txt' -o room "
                               "--paths 64k --sun-paths 256 --quiet",
                               room.string()));
  ASSERT_EQ(done.status, 0) << done.output;
  const Table hours = table(directory_ / "room" / "hours.csv"),
              expected = table(room / "three-days-expected.csv");
  ASSERT_EQ(hours.size(), 73u);
  double all = 0, all_expected = 0, worst = 0;
  for (std::size_t h = 1; h <= 72; ++h)
    for (std::size_t s = 0; s < 20; ++s) {
      const double lux = std::stod(hours[h][9 + s]), of_radiance = std::stod(expected[h][1 + s]);
      const bool overcast = h > 24 && h <= 48;
      if (overcast && of_radiance > 50) {
        worst = std::max(worst, std::abs(lux / of_radiance - 1));
        EXPECT_NEAR(lux, of_radiance, 0.03 * of_radiance) << h << ", " << s;
      }
      if (h <= 24 && s >= 16) all += lux, all_expected += of_radiance;
    }
  fmt::print("overcast: within {:.2f} %; the back row in March: {:.4f} of Radiance's\n", 100 * worst,
             all / all_expected);
  EXPECT_NEAR(all / all_expected, 1, 0.08);
}

}  // namespace
}  // namespace vitrail::test::year_test
