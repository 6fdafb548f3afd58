// SPDX-License-Identifier: Apache-2.0
#include "cli/year/sky_year.h"

#include <algorithm>

#include "scene/daylight/sky_distribution.h"
#include "scene/geometry/pi.h"

namespace vitrail {

namespace {

constexpr double lowest_sun_deg = 3;  // of Perez's sky

}  // namespace

SkyYear sky_year(const WeatherYear& weather, const SkyPatches& patches, double ground) {
  SkyYear year;
  year.patches = patches.count();
  const PatchSkies skies(patches);
  for (const WeatherHour& w : weather.hours) {
    const SunPosition sun = sun_position(w.middle, w.place);
    // An hour at whose middle the sun has not risen has the sky of one that has just done so.
    const bool is_up = sun.elevation_deg > 0;
    const SunPosition of_sky{std::max(sun.elevation_deg, lowest_sun_deg), sun.azimuth_deg};
    const MeasuredSky measured = perez_sky(w.direct_normal_w, w.diffuse_horizontal_w, of_sky, w.middle);
    YearHour hour{w.middle, sun.elevation_deg, sun.azimuth_deg};
    if (measured.distribution.diffuse_lx > 0) {
      const Vector3d to_sun = direction_of(sun);
      hour.direct_normal_lx = is_up ? measured.direct_normal_lx : 0;
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

}  // namespace vitrail
