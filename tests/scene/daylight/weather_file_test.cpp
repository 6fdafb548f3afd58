// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/weather_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::weather_file_test {
namespace {

using testing::HasSubstr;

// Half an hour's zone, and the leap day.
const std::string epw_head =
    "LOCATION,New Delhi,DL,IND,ISHRAE,421820,28.58,77.20,5.5,216\nDESIGN CONDITIONS,0\nDATA PERIODS,1,1,Data,"
    "Sunday,1/1,12/31\n";
std::string epw_line(int month, int day, int hour, const std::string& direct, const std::string& diffuse) {
  return "1999," + std::to_string(month) + "," + std::to_string(day) + "," + std::to_string(hour) +
         ",60,?9?9,20,10,50,99000,0,1400,300,500," + direct + "," + diffuse + ",1,2,3,4\n";
}

class WeatherFile : public testing::Test {
 protected:
  WeatherHour read(const std::string& name, const std::string& text, const LocalTime& moment) {
    std::ofstream(directory_ / name) << text;
    return read_weather_hour(directory_ / name, moment);
  }
  std::string refused(const std::string& name, const std::string& text, const LocalTime& moment) {
    try {
      read(name, text, moment);
    } catch (const Error& error) {
      return error.location.file + ":" + std::to_string(error.location.line) + ": " + error.what();
    }
    return "nothing is said";
  }
  test::TemporaryDirectory directory_;
};

TEST_F(WeatherFile, HoursOfAnEpwEndAtTheirNumber) {
  const std::string text = epw_head + epw_line(2, 29, 12, "640", "110") + epw_line(2, 29, 13, "650.5", "120");
  const WeatherHour noon = read("a.epw", text, {2024, 2, 29, 12, 0}),
                    before = read("a.epw", text, {2024, 2, 29, 11.99, 0});
  EXPECT_EQ(noon.direct_normal_w, 650.5);
  EXPECT_EQ(noon.diffuse_horizontal_w, 120);
  EXPECT_EQ(noon.middle.hour, 12.5);
  EXPECT_EQ(noon.middle.year, 1999);
  EXPECT_EQ(noon.middle.timezone_h, 5.5);
  EXPECT_EQ(noon.place.latitude_deg, 28.58);
  EXPECT_EQ(noon.place.longitude_deg, 77.2);
  EXPECT_EQ(before.direct_normal_w, 640);
}

TEST_F(WeatherFile, AnEpwMayHaveLux) {
  const LocalTime noon{2024, 6, 21, 12, 0};
  const auto with = [&](const std::string& lux) {
    return read("a.epw", epw_head + "1999,6,21,13,60,?,20,10,50,99000,0,1400,300,500,640,110" + lux + "\n",
                noon)
        .lux;
  };
  ASSERT_TRUE(with(",90000,60000,30000,9999"));
  EXPECT_EQ(with(",90000,60000,30000,9999")->direct_normal, 60000);
  EXPECT_EQ(with(",90000,60000,30000,9999")->diffuse_horizontal, 30000);
  for (const char* missing :
       {"", ",90000,60000", ",90000,999900,30000", ",90000,60000,999999", ",90000,,30000", ",90000,60000,-1"})
    EXPECT_FALSE(with(missing)) << missing;
}

TEST_F(WeatherFile, WestIsPositiveInAWea) {
  const std::string text =
      "place Denver_USA\nlatitude 39.74\nlongitude 105.18\ntime_zone 105\nsite_elevation 1829.0\n"
      "weather_data_file_units 1\n6 21 11.500 800 90\n6 21 12.500 810 95\n";
  const WeatherHour noon = read("a.wea", text, {2024, 6, 21, 12.25, 0});
  EXPECT_EQ(noon.direct_normal_w, 810);
  EXPECT_EQ(noon.place.longitude_deg, -105.18);
  EXPECT_EQ(noon.middle.timezone_h, -7);
  EXPECT_EQ(noon.middle.hour, 12.5);
}

TEST_F(WeatherFile, DamagedOnesAreRefusedWithTheirPlace) {
  const LocalTime noon{2024, 6, 21, 12, 0};
  EXPECT_THAT(refused("a.epw", "", noon), HasSubstr("empty"));
  EXPECT_THAT(refused("a.epw", "CONSTRUCTION,a\n", noon), HasSubstr("does not begin with LOCATION"));
  EXPECT_THAT(refused("a.epw", "LOCATION,a,b,c,d,1,95,0,0,0\n", noon), HasSubstr("no place on earth"));
  EXPECT_THAT(refused("a.epw", epw_head, noon), HasSubstr("it has no hour 06-21 12:00"));
  EXPECT_THAT(refused("a.epw", epw_head + epw_line(6, 21, 13, "9999", "100"), noon),
              HasSubstr("a.epw:4: the sun or the sky of this hour is missing"));
  EXPECT_THAT(refused("a.epw", epw_head + epw_line(6, 21, 13, "x", "100"), noon),
              HasSubstr("expected a number, found \"x\""));
  EXPECT_THAT(refused("a.epw", epw_head + "1999,6,21,13,60,9\n", noon), HasSubstr("the line has 6 values"));
  EXPECT_THAT(
      refused("a.wea",
              "place a\nlatitude 0\nlongitude 0\ntime_zone 0\nsite_elevation 0\nweather_data_file_units 2\n",
              noon),
      HasSubstr("its units are not 1"));
  EXPECT_THROW(read_weather_hour(directory_ / "none.epw", noon), Error);
}

TEST_F(WeatherFile, AYearIsAllItsHours) {
  std::ofstream(directory_ / "a.epw") << epw_head << epw_line(2, 28, 24, "0", "0")
                                      << epw_line(2, 29, 1, "9999", "20") << epw_line(3, 1, 12, "640", "110");
  const WeatherYear year = read_weather_year(directory_ / "a.epw");
  ASSERT_EQ(year.hours.size(), 3u);
  EXPECT_EQ(year.missing, 1u);
  EXPECT_EQ(year.place.latitude_deg, 28.58);
  EXPECT_EQ(year.hours[0].middle.hour, 23.5);
  EXPECT_EQ(year.hours[1].middle.day, 29);
  EXPECT_EQ(year.hours[1].diffuse_horizontal_w, 0);
  EXPECT_EQ(year.hours[2].direct_normal_w, 640);
  EXPECT_EQ(year.hours[2].middle.year, 1999);
  EXPECT_EQ(year.hours[2].middle.timezone_h, 5.5);
}

TEST_F(WeatherFile, AYearIsRefusedWithItsLine) {
  const auto refused_year = [&](const std::string& text) {
    std::ofstream(directory_ / "a.epw") << epw_head << text;
    try {
      read_weather_year(directory_ / "a.epw");
    } catch (const Error& error) {
      return std::to_string(error.location.line) + ": " + error.what();
    }
    return std::string("nothing is said");
  };
  EXPECT_THAT(refused_year(epw_line(1, 1, 1, "0", "-5")),
              HasSubstr("4: the sun or the sky of this hour is neg"));
  EXPECT_THAT(refused_year(epw_line(13, 1, 1, "0", "5")), HasSubstr("4: this is no month"));
  EXPECT_THAT(refused_year("3e9" + epw_line(1, 1, 1, "0", "5").substr(4)),
              HasSubstr("4: the year has to have four digits"));
  EXPECT_THAT(refused_year(epw_line(1, 1, 1, "0", "5") + epw_line(1, 1, 1, "0", "5")),
              HasSubstr("5: this hour has several lines"));
  EXPECT_THAT(refused_year(""), HasSubstr("there are no hours"));
}

}  // namespace
}  // namespace vitrail::weather_file_test
