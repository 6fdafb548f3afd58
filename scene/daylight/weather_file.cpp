// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/weather_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

std::string_view trimmed(std::string_view word) {
  const auto first = word.find_first_not_of(" \t\r\"");
  if (first == word.npos) return {};
  return word.substr(first, word.find_last_not_of(" \t\r\"") - first + 1);
}

// Words of a line, apart by commas or by blanks.
std::vector<std::string_view> words_of(std::string_view line, bool by_commas) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(by_commas ? "," : " \t\r", at), line.size());
    if (by_commas || end > at) words.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  return words;
}

class WeatherReader {
 public:
  explicit WeatherReader(const std::filesystem::path& file) : file_(file) {
    check_input(file);
    note_input(file);
    in_ = open_regular(file);
    if (!in_) throw Error("cannot read the weather", {file.string()});
  }

  WeatherHour hour(const LocalTime& moment) {
    const bool is_epw = read_head();
    while (next()) {
      const auto words = words_of(line_, is_epw);
      if (words.empty() || words[0].empty()) continue;
      if (auto hour = is_epw ? epw_hour(words, moment) : wea_hour(words, moment)) return *hour;
    }
    throw Error(fmt::format("it has no hour {:02}-{:02} {}:00", moment.month, moment.day, whole(moment)),
                {file_.string()});
  }

  WeatherYear year() {
    const bool is_epw = read_head();
    WeatherYear year{hour_.place, {}};
    while (next()) {
      const auto words = words_of(line_, is_epw);
      if (words.empty() || words[0].empty()) continue;
      const LocalTime moment = is_epw ? epw_moment(words) : wea_moment(words);
      const std::size_t first = is_epw ? 14 : 3;
      double direct_w = number(words, first), diffuse_w = number(words, first + 1);
      if (direct_w >= missing_w || diffuse_w >= missing_w) direct_w = diffuse_w = 0, ++year.missing;
      year.hours.push_back(measured(moment, direct_w, diffuse_w));
      year.hours.back().middle.year = is_epw ? year_in(words) : moment.year;
      if (is_epw) year.hours.back().lux = lux_of(words);
      if (year.hours.size() > 1 && is_same_hour(year.hours.end()[-2].middle, year.hours.back().middle))
        fail("this hour has several lines; one an hour is needed");
    }
    if (year.hours.empty()) throw Error("there are no hours in it", {file_.string()});
    return year;
  }

 private:
  static constexpr double missing_w = 9999;
  static bool is_same_hour(const LocalTime& a, const LocalTime& b) {
    return a.month == b.month && a.day == b.day && a.hour == b.hour;
  }
  int year_in(const auto& words) const {
    const double year = number(words, 0);
    if (!(year > -10'000 && year < 10'000)) fail("the year has to have four digits");
    return static_cast<int>(year);
  }
  // Whether it is an EPW.
  bool read_head() {
    const bool is_epw = file_.extension() == ".epw";
    is_epw ? read_epw_head() : read_wea_head();
    return is_epw;
  }
  LocalTime moment_of(double month, double day, double hour) const {
    if (!(month >= 1 && month <= 12 && day >= 1 && day <= 31 && hour >= 0 && hour < 24) ||
        month != std::floor(month) || day != std::floor(day))
      fail("this is no month, day and hour of a year");
    return {.year = 2025,
            .month = static_cast<int>(month),
            .day = static_cast<int>(day),
            .hour = hour,
            .timezone_h = hour_.middle.timezone_h};
  }
  LocalTime epw_moment(const std::vector<std::string_view>& words) const {
    return moment_of(number(words, 1), number(words, 2), number(words, 3) - 1);
  }
  LocalTime wea_moment(const std::vector<std::string_view>& words) const {
    return moment_of(number(words, 0), number(words, 1), number(words, 2));
  }
  static int whole(const LocalTime& moment) { return static_cast<int>(std::floor(moment.hour)); }

  bool next() {
    ++number_;
    return static_cast<bool>(std::getline(in_, line_));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(what, {file_.string(), number_, 1}, line_.substr(0, 200));
  }
  double number(const std::vector<std::string_view>& words, std::size_t i) const {
    if (i >= words.size()) fail(fmt::format("the line has {} values; {} are needed", words.size(), i + 1));
    double value = 0;
    const auto [end, error] = std::from_chars(words[i].data(), words[i].data() + words[i].size(), value);
    if (error != std::errc() || end != words[i].data() + words[i].size() || !std::isfinite(value))
      fail(fmt::format("expected a number, found \"{}\"", words[i]));
    return value;
  }
  void set_place(double latitude, double longitude, double zone_h) {
    if (!(std::abs(latitude) <= 90 && std::abs(longitude) <= 180 && std::abs(zone_h) <= 14))
      fail("this is no place on earth, or no time zone");
    hour_.place = {latitude, longitude};
    hour_.middle.timezone_h = zone_h;
  }

  // LOCATION, city, region, country, source, number, latitude, longitude, hours ahead of UTC, height.
  void read_epw_head() {
    if (!next()) fail("the file is empty");
    const auto words = words_of(line_, true);
    if (words[0] != "LOCATION") fail("this is no EnergyPlus weather file: it does not begin with LOCATION");
    set_place(number(words, 6), number(words, 7), number(words, 8));
    while (next())
      if (line_.starts_with("DATA PERIODS")) return;
    fail("there are no DATA PERIODS");
  }
  // Year, month, day, hour from 1 to 24, which it ends; direct and diffuse are values 15 and 16, in W/m², and
  // 18 and 19, in lx.
  std::optional<WeatherHour> epw_hour(const std::vector<std::string_view>& words, const LocalTime& moment) {
    if (number(words, 1) != moment.month || number(words, 2) != moment.day ||
        number(words, 3) != whole(moment) + 1)
      return {};
    hour_.middle.year = year_in(words);
    hour_.lux = lux_of(words);
    return measured(moment, number(words, 14), number(words, 15));
  }

  // A file may end its lines before them.
  std::optional<WeatherLux> lux_of(const std::vector<std::string_view>& words) const {
    constexpr double missing_lx = 999900;
    if (words.size() < 19 || words[17].empty() || words[18].empty()) return {};
    const WeatherLux lux{number(words, 17), number(words, 18)};
    const auto is_there = [](double lx) { return lx >= 0 && lx < missing_lx; };
    if (!is_there(lux.direct_normal) || !is_there(lux.diffuse_horizontal)) return {};
    return lux;
  }

  // Six lines of a name and a value: west is positive, the zone in degrees.
  void read_wea_head() {
    double latitude = 0, longitude = 0, zone_deg = 0;
    for (const char* name :
         {"place", "latitude", "longitude", "time_zone", "site_elevation", "weather_data_file_units"}) {
      if (!next() || !line_.starts_with(name)) fail(fmt::format("expected {}: this is no .wea file", name));
      const auto words = words_of(line_, false);
      const std::string_view of = name;
      if (of == "latitude") latitude = number(words, 1);
      if (of == "longitude") longitude = -number(words, 1);
      if (of == "time_zone") zone_deg = -number(words, 1);
      if (of == "weather_data_file_units" && number(words, 1) != 1)
        fail("its units are not 1, which is W/m2 of the sun across its direction and of the sky");
    }
    set_place(latitude, longitude, zone_deg / 15);
  }
  // Month, day, the middle of the hour, direct, diffuse.
  std::optional<WeatherHour> wea_hour(const std::vector<std::string_view>& words, const LocalTime& moment) {
    if (number(words, 0) != moment.month || number(words, 1) != moment.day ||
        std::floor(number(words, 2)) != whole(moment))
      return {};
    hour_.middle.year = moment.year;
    return measured(moment, number(words, 3), number(words, 4));
  }

  WeatherHour measured(const LocalTime& moment, double direct_w, double diffuse_w) {
    if (direct_w >= missing_w || diffuse_w >= missing_w)
      fail("the sun or the sky of this hour is missing (9999)");
    if (direct_w < 0 || diffuse_w < 0) fail("the sun or the sky of this hour is negative");
    hour_.middle.month = moment.month, hour_.middle.day = moment.day;
    hour_.middle.hour = whole(moment) + 0.5;
    hour_.direct_normal_w = direct_w, hour_.diffuse_horizontal_w = diffuse_w;
    return hour_;
  }

  std::filesystem::path file_;
  std::ifstream in_;
  std::string line_;
  int number_ = 0;
  WeatherHour hour_;
};

}  // namespace

WeatherHour read_weather_hour(const std::filesystem::path& file, const LocalTime& moment) {
  return WeatherReader(file).hour(moment);
}

WeatherYear read_weather_year(const std::filesystem::path& file) { return WeatherReader(file).year(); }

}  // namespace vitrail
