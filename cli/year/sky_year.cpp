// SPDX-License-Identifier: Apache-2.0
#include "cli/year/sky_year.h"

#include <algorithm>

#include "scene/daylight/sky_distribution.h"
#include "scene/geometry/pi.h"

namespace vitrail {

namespace {

constexpr double lowest_sun_deg = 3;  // of Perez's sky

}  // namespace

bool is_whole_year(const SkyYear& year) { return year.hours.size() >= std::size_t{365} * 24; }

SkyYear sky_year(const WeatherYear& weather, const SkyPatches& patches, double ground, bool file_lux) {
  SkyYear year;
  year.patches = patches.count();
  const PatchSkies skies(patches);
  SkyDistribution overcast = cie_sky(1, {90, 0}, {}).distribution;
  overcast.diffuse_lx = 1;
  const std::vector<double> of_overcast = skies.luminances(overcast, {0, 0, 1});
  year.overcast.assign(of_overcast.begin(), of_overcast.end());
  year.overcast[0] = static_cast<float>(ground / pi);
  for (const WeatherHour& w : weather.hours) {
    const SunPosition sun = sun_position(w.middle, w.place);
    // An hour at whose middle the sun has not risen has the sky of one that has just done so.
    const bool is_up = sun.elevation_deg > 0;
    const SunPosition of_sky{std::max(sun.elevation_deg, lowest_sun_deg), sun.azimuth_deg};
    MeasuredSky measured = perez_sky(w.direct_normal_w, w.diffuse_horizontal_w, of_sky, w.middle);
    if (file_lux && measured.distribution.diffuse_lx > 0) {
      if (w.lux && w.lux->diffuse_horizontal > 0)
        measured.distribution.diffuse_lx = w.lux->diffuse_horizontal,
        measured.direct_normal_lx = w.lux->direct_normal;
      else
        ++year.without_lux;
    }
    YearHour hour{w.middle, sun.elevation_deg, sun.azimuth_deg};
    if (measured.distribution.diffuse_lx > 0) {
      const Vector3d to_sun = direction_of(sun);
      hour.direct_normal_lx = is_up ? measured.direct_normal_lx : 0;
      hour.direct_normal_w = is_up ? w.direct_normal_w : 0, hour.diffuse_w = w.diffuse_horizontal_w;
      hour.diffuse_lx = measured.distribution.diffuse_lx;
      hour.global_lx = hour.diffuse_lx + hour.direct_normal_lx * to_sun.z;
      if (hour.direct_normal_lx > 0) hour.sun = year.suns.size(), year.suns.push_back(to_sun);
      hour.sky = year.luminances.size() / year.patches;
      std::vector<double> luminances = skies.luminances(measured.distribution, direction_of(of_sky));
      luminances[0] = ground * hour.global_lx / pi;
      year.luminances.insert(year.luminances.end(), luminances.begin(), luminances.end());
    }
    year.hours.push_back(hour);
  }
  return year;
}

std::vector<Vector3d> suns_of_day(const WeatherYear& weather, int month, int day, double above_deg) {
  std::vector<Vector3d> suns;
  if (weather.hours.empty()) return suns;
  LocalTime time = weather.hours.front().middle;
  time.month = month, time.day = day;
  constexpr int minutes = 24 * 60;
  for (int minute = 0; minute < minutes; ++minute) {
    time.hour = (minute + 0.5) / 60;
    const SunPosition sun = sun_position(time, weather.place);
    if (sun.elevation_deg > above_deg) suns.push_back(direction_of(sun));
  }
  return suns;
}

}  // namespace vitrail
