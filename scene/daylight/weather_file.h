// SPDX-License-Identifier: Apache-2.0
// These functions read hours of measured sun and sky.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "scene/daylight/sun_position.h"

namespace vitrail {

// It holds illuminances that a file has beside the watts.
struct WeatherLux {
  double direct_normal = 0;       // of the sun, across its direction
  double diffuse_horizontal = 0;  // of the sky, on a horizontal plane
};

// It holds the sun and the sky of an hour, W/m².
struct WeatherHour {
  Site place;
  LocalTime middle;                 // of the hour, by the file's clock
  double direct_normal_w = 0;       // of the sun, across its direction
  double diffuse_horizontal_w = 0;  // of the sky, on a horizontal plane
  std::optional<WeatherLux> lux;    // none: the file has none for it (from 999900 on, and below 0: missing)
};

// Reads the hour that `moment` lies in, of an EnergyPlus weather file (.epw) or of Radiance's (.wea): its
// month and day, and its time by the file's clock; the year is the file's. A moment at a full hour is of the
// hour that begins then. Throws Error with the place: where a line is damaged, where there is no such hour,
// and where its values are missing (9999).
WeatherHour read_weather_hour(const std::filesystem::path& file, const LocalTime& moment);

// It holds all hours of such a file, in its order.
struct WeatherYear {
  Site place;
  std::vector<WeatherHour> hours;
  std::size_t missing = 0;  // hours whose sun or sky is missing: both are 0 there
};
// Throws Error as read_weather_hour does, but for missing values; also where an hour has several lines.
WeatherYear read_weather_year(const std::filesystem::path& file);

}  // namespace vitrail
