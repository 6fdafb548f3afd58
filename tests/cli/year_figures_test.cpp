// SPDX-License-Identifier: Apache-2.0
#include "cli/year/year_figures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/daylight/sun_position.h"
#include "scene/geometry/pi.h"

namespace vitrail::year_figures_test {
namespace {

// One patch, and one sun that shines in the second hour.
SkyYear four_hours() {
  SkyYear year;
  year.patches = 2;
  const auto add = [&](int clock, float luminance, double direct_lx) {
    YearHour hour;
    hour.middle.hour = clock + 0.5;
    hour.diffuse_lx = static_cast<double>(luminance);
    hour.direct_normal_lx = direct_lx;
    if (direct_lx > 0) hour.sun = year.suns.size(), year.suns.push_back({0, 0, 1});
    hour.sky = year.luminances.size() / 2;
    year.luminances.insert(year.luminances.end(), {0, luminance});
    year.hours.push_back(hour);
  };
  add(8, 50, 0), add(9, 350, 10000), add(10, 4000, 0), add(20, 360, 0);
  return year;
}

StateCoefficients state(const NearSuns& near, float error) {
  StateCoefficients c{"clear", {1, 2, {0, 1}, {0, error}}, {}, {}, {}};
  set_suns(c, {1, 1, {0.5f}, {0}}, {1, 1, {0.01f}, {error}}, near);
  return c;
}

SensorYear figures(float error) {
  const SkyYear year = four_hours();
  const NearSuns near = near_suns(year.suns, 3);
  return sensor_year(year, near, {state(near, error)}, {0, 0, 0, 0}, 0, counted_hours(year, {}), {});
}

// The sky is that of a sun at 3° where it is lower; the sun itself shines from where it is.
TEST(SkyYear, HasALowSunWhereItStands) {
  WeatherYear weather;
  weather.hours = {{{48.86, 2.35}, {2001, 3, 21, 6.5, 1}, 500, 100}, {{48.86, 2.35}, {2001, 3, 21, 6.8, 1}, 500, 100}};
  const SkyYear year = sky_year(weather, SkyPatches(1), 0);
  ASSERT_EQ(year.suns.size(), 1u);
  EXPECT_LT(year.hours[0].elevation_deg, 0);
  const double elevation = year.hours[1].elevation_deg;
  EXPECT_GT(elevation, 0);
  EXPECT_LT(elevation, 3);
  EXPECT_NEAR(std::asin(year.suns[0].z), elevation * radian, 1e-9);
}

TEST(YearFigures, AreSharesOfTheHoursOfUse) {
  const SensorYear s = figures(0);
  EXPECT_EQ(s.lux, (std::vector<float>{50, 350 + 5100, 4000, 360}));
  EXPECT_EQ(s.beam, (std::vector<float>{0, 5000, 0, 0}));
  const auto value = [&](Figure f) { return s.estimate(f).value; };
  EXPECT_NEAR(value(Figure::mean_lx), (50 + 5450 + 4000) / 3.0, 1e-3);
  EXPECT_NEAR(value(Figure::autonomy), 2.0 / 3, 1e-9);
  EXPECT_NEAR(value(Figure::continuous_autonomy), (50 / 300.0 + 2) / 3, 1e-9);
  EXPECT_NEAR(value(Figure::useful_too_low), 1.0 / 3, 1e-9);
  EXPECT_NEAR(value(Figure::useful_low), 0, 1e-9);
  EXPECT_NEAR(value(Figure::useful_enough), 0, 1e-9);
  EXPECT_NEAR(value(Figure::useful_too_high), 2.0 / 3, 1e-9);
  EXPECT_NEAR(value(Figure::sun_hours), 1, 1e-9);
  // The two hours with most of the sky: at 10 and at 20 h.
  EXPECT_NEAR(value(Figure::daylight_300), 1, 1e-9);
  EXPECT_NEAR(value(Figure::daylight_500), 0.5, 1e-9);
  for (std::size_t f = 0; f < figure_count; ++f) EXPECT_LT(s.estimate(static_cast<Figure>(f)).error, 1e-9);
  EXPECT_EQ(figure_kinds().size(), figure_count);
}

TEST(YearFigures, ErrorsFollowThoseOfTheCoefficients) {
  const SensorYear s = figures(0.1f);
  EXPECT_NEAR(s.error[0], 5, 1e-3);
  EXPECT_NEAR(s.error[1], std::hypot(35, 1000), 1);
  const Estimate mean = s.estimate(Figure::mean_lx);
  // Of one patch the sky's errors go together: 4400/3 · 0.1, and 1000/3 of the sun's.
  EXPECT_GT(mean.error, 0.5 * std::hypot(147, 333));
  EXPECT_LT(mean.error, 2 * std::hypot(147, 333));
}

TEST(YearFigures, OfAnAreaCountItsSensorsAlone) {
  const SensorYear lit = figures(0);
  SensorYear dark = lit;
  for (auto& figure : dark.figures) figure.fill(0);
  const AreaFigures area = area_figures({lit, dark, dark}, {true, true, false});
  EXPECT_NEAR(area.autonomy.value, 0.5, 1e-9);
  EXPECT_NEAR(area.mean_autonomy.value, 1.0 / 3, 1e-9);
  EXPECT_NEAR(area.sunlight.value, 0, 1e-9);  // not 250 hours
  ASSERT_EQ(area.provision.size(), 3u);
  EXPECT_NEAR(area.provision[0].target.value, 0.5, 1e-9);
  EXPECT_FALSE(area.provision[0].holds());  // 100 lx on half of the area, in place of 95 %
  EXPECT_TRUE(area_figures({lit}, {true}).provision[0].holds());
}

TEST(NearSuns, WeighThoseThatAreClose) {
  const std::vector<Vector3d> suns{direction_of({30, 180}), direction_of({31, 180}), direction_of({40, 180})};
  const NearSuns near = near_suns(suns, 3);
  ASSERT_EQ(near.of[0].size(), 2u);
  EXPECT_NEAR(near.of[0][0].weight, 1 / (1 + 2.0 / 3), 1e-3);
  EXPECT_NEAR(near.of[0][1].weight, 2.0 / 3 / (1 + 2.0 / 3), 1e-3);
  ASSERT_EQ(near.of[2].size(), 1u);
  EXPECT_EQ(near.of[2][0].weight, 1);
  for (const auto& of : near_suns(suns, 0).of) EXPECT_EQ(of.size(), 1u);
}

}  // namespace
}  // namespace vitrail::year_figures_test
