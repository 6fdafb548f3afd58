// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/sun_and_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/mitsuba/properties.h"
#include "scene/rgb_to_spectrum.h"

namespace vitrail::mitsuba {

namespace {

constexpr double radian = std::numbers::pi / 180;

using Row = std::array<double, 6>;
constexpr std::array<double, 7> turbidities{1, 2, 3, 4, 6, 8, 10}, elevations_deg{2, 5, 10, 20, 40, 60, 85};
constexpr std::array<Row, 49> means{{
#include "importers/mitsuba/sky_means.inl"
}};

// Where x lies in the ascending list, as an index and a fraction.
template <std::size_t n>
std::pair<std::size_t, double> place_in(const std::array<double, n>& list, double x) {
  const double held = std::clamp(x, list.front(), list.back());
  std::size_t i = 0;
  while (i + 2 < n && held > list[i + 1]) ++i;
  return {i, (held - list[i]) / (list[i + 1] - list[i])};
}

// Days from January 1st.
int day_of_year(int year, int month, int day) {
  constexpr std::array<int, 12> before{0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return before[static_cast<std::size_t>(std::clamp(month, 1, 12) - 1)] + day - 1 + (leap && month > 2);
}

TimeAndPlace read_time(const Object& o, const Report& report) {
  TimeAndPlace at;
  at.year = o.integer("year", at.year, report);
  at.month = o.integer("month", at.month, report);
  at.day = o.integer("day", at.day, report);
  at.hour = o.number("hour", at.hour, report) + o.number("minute", 0, report) / 60 +
            o.number("second", 0, report) / 3600;
  at.latitude_deg = o.number("latitude", at.latitude_deg, report);
  at.longitude_deg = o.number("longitude", at.longitude_deg, report);
  at.timezone = o.number("timezone", at.timezone, report);
  return at;
}

// Towards the sun, from the time: 0.6 has +y up, +x in the east and −z in the north, 3 has +z up, −y in the
// east and −x in the north.
Vector3d local_direction(const Object& o, bool y_is_up, const Report& report) {
  const auto [elevation, azimuth] = sun_position(read_time(o, report));
  const double up = std::sin(elevation), north = std::cos(azimuth) * std::cos(elevation),
               east = std::sin(azimuth) * std::cos(elevation);
  return y_is_up ? Vector3d{east, up, -north} : Vector3d{-north, -east, up};
}

}  // namespace

Daylight daylight(double turbidity, double elevation_deg) {
  const auto [t, u] = place_in(turbidities, turbidity);
  const auto [e, v] = place_in(elevations_deg, elevation_deg);
  const auto at = [&, t = t, u = u, e = e, v = v](std::size_t i) {
    const auto row = [&](std::size_t k) {
      return means[k * 7 + e][i] * (1 - v) + means[k * 7 + e + 1][i] * v;
    };
    return row(t) * (1 - u) + row(t + 1) * u;
  };
  Daylight light{{at(0), at(1), at(2)}, {at(3), at(4), at(5)}};
  if (elevation_deg <= 0) light.sun = {};
  return light;
}

std::array<double, 2> sun_position(const TimeAndPlace& at) {
  const double g =
      2 * std::numbers::pi / 365 * (day_of_year(at.year, at.month, at.day) + (at.hour - 12) / 24);
  const double declination = 0.006918 - 0.399912 * std::cos(g) + 0.070257 * std::sin(g) -
                             0.006758 * std::cos(2 * g) + 0.000907 * std::sin(2 * g) -
                             0.002697 * std::cos(3 * g) + 0.00148 * std::sin(3 * g);
  const double minutes = 229.18 * (0.000075 + 0.001868 * std::cos(g) - 0.032077 * std::sin(g) -
                                   0.014615 * std::cos(2 * g) - 0.040849 * std::sin(2 * g));
  const double solar_hour = at.hour - at.timezone + at.longitude_deg / 15 + minutes / 60;
  const double angle = (solar_hour - 12) * 15 * radian, latitude = at.latitude_deg * radian;
  const double up = std::sin(latitude) * std::sin(declination) +
                    std::cos(latitude) * std::cos(declination) * std::cos(angle);
  const double north = std::cos(latitude) * std::sin(declination) -
                       std::sin(latitude) * std::cos(declination) * std::cos(angle);
  const double east = -std::cos(declination) * std::sin(angle);
  return {std::asin(std::clamp(up, -1.0, 1.0)), std::atan2(east, north)};
}

bool is_daylight(const std::string& kind) { return kind == "sky" || kind == "sun" || kind == "sunsky"; }

void add_daylight(Builder& builder, const Object& emitter) {
  Report& report = builder.report;
  const Transform to_world = emitter.transform("to_world", report);
  const bool y_is_up = emitter.boolean("y_is_up", false, report);  // of old files (old_versions.cpp)
  // A direction that is given is the world's.
  const auto given = emitter.vector("sun_direction", report);
  const Vector3d local =
      given ? unit(transform_vector(inverse(to_world), *given)) : local_direction(emitter, y_is_up, report);
  const double up = std::asin(std::clamp(y_is_up ? local.y : local.z, -1.0, 1.0)) / radian;
  const double turbidity = emitter.number("turbidity", 3, report), scale = emitter.number("scale", 1, report);
  const Daylight light = daylight(turbidity, up);
  const auto times = [](RGB c, double k) { return emission_from_rgb({c.r * k, c.g * k, c.b * k}); };
  const double sky_scale = scale * emitter.number("sky_scale", 1, report),
               sun_scale = scale * emitter.number("sun_scale", 1, report);
  if (emitter.type != "sun" && sky_scale > 0)
    builder.scene.lights.push_back({InfiniteLight{times(light.sky, sky_scale)}, emitter.origin});
  const Vector3d along = unit(transform_vector(to_world, local)) * -1.0;
  if (emitter.type != "sky" && sun_scale > 0 && length(along) > 0)
    builder.scene.lights.push_back({DistantLight{along, times(light.sun, sun_scale)}, emitter.origin});
  emitter.ignore(
      {"albedo", "stretch", "resolution", "sun_radius_scale", "sun_aperture", "extend", "complex_sun"});
  report.approximated(
      fmt::format(
          "emitter \"{}\" becomes {}: the sky's mean radiance from everywhere, the sun's irradiance from "
          "one direction, as of Mitsuba 3.9.1's at turbidity {:.3g} and {:.1f}° of elevation",
          emitter.type,
          emitter.type == "sky"   ? "a uniform light"
          : emitter.type == "sun" ? "a distant light"
                                  : "a uniform and a distant light",
          turbidity, up),
      emitter.origin);
  report_unused(emitter, report, {"turbidity", "sun_direction", "sky_scale", "sun_scale", "to_world"});
}

}  // namespace vitrail::mitsuba
