// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/sun_and_sky.h"

#include <cmath>

#include "importers/mitsuba/properties.h"
#include "scene/sun_position.h"

namespace vitrail::mitsuba {

namespace {

// Mitsuba's defaults are of Tokyo.
SunPosition read_sun_position(const Object& o, const Report& report) {
  LocalTime time{2010, 7, 10, 15, 9};
  time.year = o.integer("year", time.year, report);
  time.month = o.integer("month", time.month, report);
  time.day = o.integer("day", time.day, report);
  time.hour = o.number("hour", time.hour, report) + o.number("minute", 0, report) / 60 +
              o.number("second", 0, report) / 3600;
  time.timezone_h = o.number("timezone", time.timezone_h, report);
  constexpr int furthest = 9999;
  if (std::abs(time.year) > furthest) report.fail("the year has to be within ±9999", o.origin);
  const double latitude = o.number("latitude", 35.6894, report),
               longitude = o.number("longitude", 139.6917, report);
  return sun_position(time, {latitude, longitude});
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

// Towards the sun in the light's frame, by the time. Version 3 has −y in the east and −x in the north.
Vector3d by_time(const Object& emitter, bool y_is_up, const Report& report) {
  const Vector3d d = direction_of(read_sun_position(emitter, report));
  return y_is_up ? d : Vector3d{-d.y, -d.x, d.z};
}

}  // namespace

bool is_daylight(const std::string& kind) { return kind == "sky" || kind == "sun" || kind == "sunsky"; }

void add_daylight(Builder& builder, const Object& emitter) {
  Report& report = builder.report;
  const bool y_is_up = emitter.boolean("y_is_up", false, report);  // of old files (old_versions.cpp)
  SkyLight light;
  light.light_to_world = emitter.transform("to_world", report) * light_to_emitter(y_is_up);
  if (!is_invertible(light.light_to_world))
    report.fail("the emitter's to_world has no inverse", place_of(emitter, "to_world"));
  // A direction that is given is the world's.
  const auto given = emitter.vector("sun_direction", report);
  light.to_sun = given ? unit(transform_vector(inverse(light.light_to_world), *given))
                       : by_time(emitter, y_is_up, report);
  if (!(length(light.to_sun) > 0))
    report.fail("the sun has no direction", place_of(emitter, "sun_direction"));
  const auto number = [&](const char* name, double otherwise) {
    return static_cast<float>(emitter.number(name, otherwise, report));
  };
  light.turbidity = number("turbidity", 3);
  light.albedo = spectrum_value(builder, emitter, "albedo", Quantity::reflectance,
                                ConstantSpectrum{y_is_up ? 0.15f : 0.3f});
  const float scale = number("scale", 1);
  light.sky_scale = emitter.type == "sun" ? 0 : scale * number("sky_scale", 1);
  light.sun_scale = emitter.type == "sky" ? 0 : scale * number("sun_scale", 1);
  light.sun_diameter_deg = number("sun_aperture", 0.5358) * number("sun_radius_scale", 1);
  light.limb_darkening = emitter.boolean("complex_sun", false, report);
  if (!(light.sun_diameter_deg > 0 && light.sun_diameter_deg < 180))
    report.fail("the sun's diameter is not between 0 and 180 degrees", emitter.origin);
  if (y_is_up)
    report.approximated("the model of daylight of Mitsuba 0.6 becomes that of version 3 (Hošek and Wilkie)",
                        emitter.origin);
  if (light.to_sun.z < 0)
    report.approximated("the sun is below the horizon: the model has no twilight, nothing shines",
                        emitter.origin);
  emitter.ignore({"stretch", "resolution", "extend"});
  builder.scene.lights.push_back({light, emitter.origin});
  report_unused(emitter, report,
                {"turbidity", "albedo", "sun_direction", "sky_scale", "sun_scale", "sun_aperture",
                 "complex_sun", "to_world"});
}

}  // namespace vitrail::mitsuba
