// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/sun_and_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/mitsuba/read/properties.h"
#include "scene/daylight/sun_position.h"

namespace vitrail::mitsuba {

namespace {

constexpr int furthest = 9999;  // year, month or day

// Mitsuba's defaults are of Tokyo.
Site read_place(const Object& o, const Report& report) {
  return {o.number("latitude", 35.6894, report), o.number("longitude", 139.6917, report)};
}

void read_date(const Object& o, const std::string& prefix, LocalTime& time, const Report& report) {
  time.year = o.integer(prefix + "year", time.year, report);
  time.month = o.integer(prefix + "month", time.month, report);
  time.day = o.integer(prefix + "day", time.day, report);
  for (const int part : {time.year, time.month, time.day})
    if (part < -furthest || part > furthest)
      report.fail("year, month and day have to be within ±9999", o.origin);
}

SunPosition read_sun_position(const Object& o, const Report& report) {
  LocalTime time{2010, 7, 10, 15, 9};
  read_date(o, "", time, report);
  time.hour = o.number("hour", time.hour, report) + o.number("minute", 0, report) / 60 +
              o.number("second", 0, report) / 3600;
  time.timezone_h = o.number("timezone", time.timezone_h, report);
  return sun_position(time, read_place(o, report));
}

// The light's frame, +z up and the sun by its azimuth from +y to +x, in that of the emitter: 0.6 has +y up,
// +x in the east and −z in the north.
Transform light_to_emitter(bool y_is_up) {
  Transform t;
  if (!y_is_up) return t;
  t.m[0] = {1, 0, 0, 0};
  t.m[1] = {0, 0, 1, 0};
  t.m[2] = {0, -1, 0, 0};
  return t;
}

// Towards the sun in the light's frame: version 3 has −y in the east and −x in the north.
Vector3d in_version_3(const SunPosition& sun) {
  const Vector3d d = direction_of(sun);
  return {-d.y, -d.x, d.z};
}

Vector3d by_time(const Object& emitter, bool y_is_up, const Report& report) {
  const SunPosition sun = read_sun_position(emitter, report);
  return y_is_up ? direction_of(sun) : in_version_3(sun);
}

// A timed_sunsky goes through the hours of a window, on each day from one date to another, while the sensor's
// time goes through the emitter's shutter. Where the sun stands meanwhile: once, or at middles of equal
// times.
std::vector<Vector3d> suns_over_time(const Builder& builder, const Object& o) {
  const Report& report = builder.report;
  constexpr int moments = 32;
  LocalTime start{2025, 1, 1, 0, 9};
  read_date(o, "start_", start, report);
  start.timezone_h = o.number("timezone", start.timezone_h, report);
  LocalTime end = start;
  end.year = start.year + 1;
  read_date(o, "end_", end, report);
  const double first_h = o.number("window_start_time", 7, report),
               last_h = o.number("window_end_time", 19, report), open = o.number("shutter_open", 0, report),
               close = o.number("shutter_close", 1, report);
  if (!(first_h >= 0 && first_h <= last_h && last_h <= 24))
    report.fail("the window of time has to be hours from 0 to 24, the first before the last", o.origin);
  if (!(open < close)) report.fail("\"shutter_close\" has to be above \"shutter_open\"", o.origin);
  const double days = days_from_2000(end) - days_from_2000(start);
  const Site place = read_place(o, report);
  const bool once = !(builder.shutter_open < builder.shutter_close);
  std::vector<Vector3d> suns;
  for (int i = 0; i < (once ? 1 : moments); ++i) {
    const double part = once ? 0 : (i + 0.5) / moments,
                 time = builder.shutter_open + part * (builder.shutter_close - builder.shutter_open);
    const double day = (time - open) / (close - open) * days;
    if (!(std::abs(day) < furthest * 366.0))
      report.fail("the sensor's shutter is open thousands of years before or after the emitter's", o.origin);
    LocalTime at = start;
    at.day += static_cast<int>(std::floor(day));
    at.hour = first_h + (last_h - first_h) * (day - std::floor(day));
    suns.push_back(in_version_3(sun_position(at, place)));
  }
  return suns;
}

}  // namespace

bool is_daylight(const std::string& kind) {
  return kind == "sky" || kind == "sun" || kind == "sunsky" || kind == "timed_sunsky";
}

void add_daylight(Builder& builder, const Object& emitter) {
  Report& report = builder.report;
  const bool y_is_up = emitter.boolean("y_is_up", false, report);  // of old files (old_versions.cpp)
  SkyLight light;
  light.light_to_world = emitter.transform("to_world", report) * light_to_emitter(y_is_up);
  if (!is_invertible(light.light_to_world))
    report.fail("the emitter's to_world has no inverse", place_of(emitter, "to_world"));
  std::vector<Vector3d> suns;
  if (emitter.type == "timed_sunsky") {
    suns = suns_over_time(builder, emitter);
    if (suns.size() > 1)
      report.approximated(fmt::format("light over a span of time: that of {} moments of it", suns.size()),
                          emitter.origin);
  } else {
    // A direction that is given is the world's.
    const auto given = emitter.vector("sun_direction", report);
    suns.push_back(given ? unit(transform_vector(inverse(light.light_to_world), *given))
                         : by_time(emitter, y_is_up, report));
    if (!(length(suns[0]) > 0)) report.fail("the sun has no direction", place_of(emitter, "sun_direction"));
  }
  const auto number = [&](const char* name, double otherwise) {
    return static_cast<float>(emitter.number(name, otherwise, report));
  };
  light.turbidity = number("turbidity", 3);
  light.albedo = spectrum_value(builder, emitter, "albedo", Quantity::reflectance,
                                ConstantSpectrum{y_is_up ? 0.15f : 0.3f});
  const float scale = number("scale", 1) / static_cast<float>(suns.size());
  light.sky_scale = emitter.type == "sun" ? 0 : scale * number("sky_scale", 1);
  light.sun_scale = emitter.type == "sky" ? 0 : scale * number("sun_scale", 1);
  light.sun_diameter_deg = number("sun_aperture", 0.5358) * number("sun_radius_scale", 1);
  light.limb_darkening = emitter.boolean("complex_sun", false, report);
  if (!(light.sun_diameter_deg > 0 && light.sun_diameter_deg < 180))
    report.fail("the sun's diameter is not between 0 and 180 degrees", emitter.origin);
  if (y_is_up)
    report.approximated("the model of daylight of Mitsuba 0.6 becomes that of version 3 (Hošek and Wilkie)",
                        emitter.origin);
  if (std::ranges::all_of(suns, [](const Vector3d& d) { return d.z < 0; }))
    report.approximated("the sun is below the horizon: the model has no twilight, nothing shines",
                        emitter.origin);
  emitter.ignore({"stretch", "resolution", "extend"});
  for (const Vector3d& to_sun : suns) {
    light.to_sun = to_sun;
    builder.scene.lights.push_back({.model = light, .origin = emitter.origin, .name = name_of(emitter)});
  }
  report_unused(emitter, report,
                {"turbidity", "albedo", "sun_direction", "sky_scale", "sun_scale", "sun_aperture",
                 "complex_sun", "to_world"});
}

}  // namespace vitrail::mitsuba
