// SPDX-License-Identifier: Apache-2.0
// Mitsuba's models of daylight: 0.6's "sky", "sun" and "sunsky", 3's "sunsky". The Scene has no sky that
// varies without an image, and readers write no images: what stands for them has the light of the whole of
// each.
#pragma once

#include <array>

#include "importers/mitsuba/builder.h"

namespace vitrail::mitsuba {

// Linear sRGB, W·m⁻²·sr⁻¹·nm⁻¹ and W·m⁻²·nm⁻¹.
struct Daylight {
  RGB sky;  // mean radiance of the upper hemisphere
  RGB sun;  // irradiance across its direction
};
// Between what Mitsuba 3.9.1 has (sky_means.inl, by Hošek and Wilkie 2012 and 2013), bilinear in the
// turbidity, 1 … 10, and the sun's elevation, 2° … 85°; held beyond. No sun at or below the horizon.
Daylight daylight(double turbidity, double elevation_deg);

struct TimeAndPlace {
  int year = 2010, month = 7, day = 10;
  double hour = 15;                                                       // local time
  double latitude_deg = 35.6894, longitude_deg = 139.6917, timezone = 9;  // Tokyo: Mitsuba's
};
// Elevation above the horizon and azimuth from north towards east, in radians: the declination and the
// equation of time of Spencer (1971), good to half a degree.
std::array<double, 2> sun_position(const TimeAndPlace& at);

bool is_daylight(const std::string& kind);

// Adds the uniform light of the sky and the distant one of the sun, and says so.
void add_daylight(Builder& builder, const Object& emitter);

}  // namespace vitrail::mitsuba
