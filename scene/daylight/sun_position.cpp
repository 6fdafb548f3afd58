// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/sun_position.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scene/geometry/pi.h"
#include "scene/geometry/portable_math.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

double sine(double degrees) { return portable_sin(degrees * radian); }
double cosine(double degrees) { return portable_cos(degrees * radian); }

int days_of(int year, int month) {
  if (month == 2) return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0 ? 29 : 28;
  return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

}  // namespace

// Midnight by Fliegel and Van Flandern 1968.
double days_from_2000(const LocalTime& t) {
  const int a = (t.month - 14) / 12;
  const int noon = (1461 * (t.year + 4800 + a)) / 4 + (367 * (t.month - 2 - 12 * a)) / 12 -
                   (3 * ((t.year + 4900 + a) / 100)) / 4 + t.day - 32075;
  return noon - 2451545 - 0.5 + (t.hour - t.timezone_h) / 24;
}

LocalTime local_time(const std::string& text) {
  LocalTime t;
  int hour = 0, minute = 0, used = 0;
  double second = 0;
  const auto fail = [&]() -> LocalTime {
    throw Error(fmt::format("expected a time such as 2026-06-21T12:00+02:00, found \"{}\"", text));
  };
  if (std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d%n", &t.year, &t.month, &t.day, &hour, &minute, &used) !=
      5)
    return fail();
  const char* rest = text.c_str() + used;
  if (*rest == ':') {
    if (std::sscanf(rest, ":%lf%n", &second, &used) != 1 || rest[1] == '+' || rest[1] == '-') return fail();
    rest += used;
  }
  int zone_hour = 0, zone_minute = 0;
  if (std::string_view(rest) != "Z") {
    used = 0;
    if ((*rest != '+' && *rest != '-') ||
        std::sscanf(rest + 1, "%2d:%2d%n", &zone_hour, &zone_minute, &used) != 2 || rest[1 + used] != 0)
      return fail();
    t.timezone_h = (zone_hour + zone_minute / 60.0) * (*rest == '-' ? -1 : 1);
  }
  const auto within = [](auto x, auto low, auto high) { return x >= low && x <= high; };
  if (!within(t.month, 1, 12) || !within(t.day, 1, days_of(t.year, t.month)) || !within(hour, 0, 24) ||
      !within(minute, 0, 59) || !within(second, 0.0, 60.0) || !within(zone_hour, 0, 14) ||
      !within(zone_minute, 0, 59))
    return fail();
  t.hour = hour + minute / 60.0 + second / 3600;
  return t;
}

SunPosition sun_position(const LocalTime& time, const Site& place) {
  const double days = days_from_2000(time), T = days / 36525;
  const double mean_longitude = 280.46646 + T * (36000.76983 + T * 0.0003032);
  const double anomaly = 357.52911 + T * (35999.05029 - T * 0.0001537);
  const double centre = (1.914602 - T * (0.004817 + T * 0.000014)) * sine(anomaly) +
                        (0.019993 - T * 0.000101) * sine(2 * anomaly) + 0.000289 * sine(3 * anomaly);
  const double node = 125.04 - 1934.136 * T;
  const double longitude = mean_longitude + centre - 0.00569 - 0.00478 * sine(node);
  const double obliquity = 23.4392911 - T * (0.0130042 + T * 1.64e-7) + 0.00256 * cosine(node);
  const double right_ascension =
      portable_atan2(cosine(obliquity) * sine(longitude), cosine(longitude)) / radian;
  const double sin_declination = sine(obliquity) * sine(longitude),
               cos_declination = safe_sqrt(1 - sin_declination * sin_declination);
  const double sidereal =
      280.46061837 + 360.98564736629 * days + T * T * 0.000387933 - 0.00478 * sine(node) * cosine(obliquity);
  const double hour_angle = sidereal + place.longitude_deg - right_ascension;

  const double sin_latitude = sine(place.latitude_deg), cos_latitude = cosine(place.latitude_deg);
  const double up = sin_latitude * sin_declination + cos_latitude * cos_declination * cosine(hour_angle);
  const double north = cos_latitude * sin_declination - sin_latitude * cos_declination * cosine(hour_angle);
  const double east = -cos_declination * sine(hour_angle);
  const double elevation = 90 - portable_acos(up) / radian;
  constexpr double parallax_deg = 8.794 / 3600;
  const double azimuth = portable_atan2(east, north) / radian;
  return {elevation - parallax_deg * safe_sqrt(1 - up * up), azimuth < 0 ? azimuth + 360 : azimuth};
}

Vector3d direction_of(const SunPosition& p) {
  const double flat = cosine(p.elevation_deg);
  return {flat * sine(p.azimuth_deg), flat * cosine(p.azimuth_deg), sine(p.elevation_deg)};
}

}  // namespace vitrail
