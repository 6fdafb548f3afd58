// SPDX-License-Identifier: Apache-2.0
// A SkyYear holds the hours of a weather file as skies and suns.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scene/daylight/patch_skies.h"
#include "scene/daylight/weather_file.h"

namespace vitrail {

// Directions have +x east, +y north, +z up. At night all light is 0.
struct YearHour {
  LocalTime middle;
  double elevation_deg = 0, azimuth_deg = 0;                   // of the sun in the middle of the hour
  double direct_normal_lx = 0, diffuse_lx = 0, global_lx = 0;  // outdoors; the last two on the ground
  double direct_normal_w = 0,
         diffuse_w = 0;            // as measured, W/m², across the sun's direction and on the ground
  std::optional<std::size_t> sun;  // which of SkyYear::suns; none: without sun
  std::optional<std::size_t> sky;  // which row of SkyYear::luminances; none: night
  int clock_hour() const { return static_cast<int>(middle.hour); }
};

struct SkyYear {
  std::vector<YearHour> hours;
  std::size_t without_lux = 0;  // lit hours whose own lux, asked for, are missing in the file
  std::vector<Vector3d> suns;
  std::size_t patches = 0;
  std::vector<float> luminances;  // [sky][patch], cd/m²; the first patch is the ground
  std::vector<float> overcast;    // [patch]: the overcast sky of the CIE that gives 1 lx on the ground
  std::span<const float> sky_of(const YearHour& hour) const {
    return {&luminances[*hour.sky * patches], patches};
  }
};

// Returns whether there are all hours of a year.
bool is_whole_year(const SkyYear& year);

// Makes of each hour the all-weather sky of Perez (sky_distribution.h) and the sun where it stands in the
// middle of the hour. The ground is as bright as a white sheet that reflects `ground` of the global
// illuminance. If the sun is below the horizon then, there is the hour's sky without sun. Its lux follow from
// the watts by Perez's efficacies, or are the `file_lux` where the file has them.
SkyYear sky_year(const WeatherYear& weather, const SkyPatches& patches, double ground, bool file_lux = false);

// Returns where the sun stands in the middle of each minute of a day of the weather's year,
// while it is higher than `above_deg`.
std::vector<Vector3d> suns_of_day(const WeatherYear& weather, int month, int day, double above_deg);

}  // namespace vitrail
