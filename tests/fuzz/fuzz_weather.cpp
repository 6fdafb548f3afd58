// SPDX-License-Identifier: Apache-2.0
// Hours of an EPW or, behind a `w`, of a WEA: the year, an hour of it, and the skies that both tell.
#include "scene/daylight/given_sky.h"
#include "scene/daylight/sky_distribution.h"
#include "scene/daylight/sky_model.h"
#include "scene/daylight/weather_file.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  const bool is_wea = size > 0 && data[0] == 'w';
  const std::filesystem::path file =
      fuzz::write(is_wea ? "year.wea" : "year.epw", data + (is_wea ? 1 : 0), size - (is_wea ? 1 : 0));
  fuzz::run([&] {
    const WeatherYear year = read_weather_year(file);
    for (const WeatherHour& hour : year.hours) {
      const SunPosition sun = sun_position(hour.middle, hour.place);
      const MeasuredSky sky = perez_sky(hour.direct_normal_w, hour.diffuse_horizontal_w, sun, hour.middle);
      fuzz::require(sky.direct_normal_lx >= 0 && sky.distribution.diffuse_lx >= 0);
    }
  });
  return fuzz::run([&] {
    const GivenSky sky = parse_sky(file.string() + "@06-21T12:00");
    for (const double radiance : SkyModel(sky.light).sky(Vector3d{0, 0, 1}))
      fuzz::require(radiance >= 0 && std::isfinite(radiance));
  });
}
