// SPDX-License-Identifier: Apache-2.0
// These functions compute where the sun stands.
#pragma once

#include <string>

#include "scene/geometry/vec.h"

namespace vitrail {

// It is a moment of the Gregorian calendar, by a clock that is `timezone_h` ahead of UTC. Fields may go over:
// hour 25 is 1 o'clock of the next day.
struct LocalTime {
  int year = 2026, month = 6, day = 21;
  double hour = 12;  // with its fraction
  double timezone_h = 0;
};

// It is a place on the Earth in degrees, north and east positive.
struct Site {
  double latitude_deg = 0, longitude_deg = 0;
};

// Returns the days in UTC from the noon of January 1st 2000 (J2000.0).
double days_from_2000(const LocalTime& time);

// Reads "2026-06-21T12:00+02:00": date, T, hours and minutes, perhaps :seconds, then Z or ±hh:mm (ISO 8601).
// Throws Error, also where there is no such date.
LocalTime local_time(const std::string& text);

// It is the position of the sun's centre, seen from the surface: parallax included, refraction not. Azimuth
// counts from north to east.
struct SunPosition {
  double elevation_deg = 0, azimuth_deg = 0;
};
// Returns the sun's position, by its apparent longitude to 0.01° between 1950 and 2050 (Meeus, Astronomical
// Algorithms, 2nd ed. 1998, chapter 25, the lower accuracy; sidereal time of chapter 12). UTC is taken for
// dynamical time.
SunPosition sun_position(const LocalTime& time, const Site& place);

// Returns the direction towards the sun where +x is east, +y north and +z up.
Vector3d direction_of(const SunPosition& position);

}  // namespace vitrail
