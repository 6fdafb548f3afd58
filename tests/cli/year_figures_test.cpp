// SPDX-License-Identifier: Apache-2.0
#include "cli/year/solar_heat.h"

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
    year.overcast = {0, 0.5f};
    year.hours.push_back(hour);
  };
  add(8, 50, 0), add(9, 350, 10000), add(10, 4000, 0), add(20, 360, 0);
  return year;
}

// Of one sensor. The melanopic part is half of the light.
Coefficients coefficients(std::vector<float> mean, std::vector<float> error) {
  std::vector<float> melanopic = mean;
  for (float& value : melanopic) value /= 2;
  return {1, mean.size(), std::move(mean), std::move(error), std::move(melanopic)};
}

StateCoefficients state(const NearSuns& near, float error) {
  StateCoefficients c{"clear", coefficients({0, 1}, {0, error}), {}, {}, {}};
  set_suns(c, coefficients({0.5f}, {0}), coefficients({0.01f}, {error}), near);
  return c;
}

SensorYear figures(float error) {
  const SkyYear year = four_hours();
  const NearSuns near = near_suns(year.suns, 3);
  return sensor_year(year, near, {state(near, error)}, {{0, 0, 0, 0}, {0, 0, 0, 0}, 0}, 0,
                     counted_hours(year, {}), {});
}

// The sky is that of a sun at 3° where it is lower; the sun itself shines from where it is.
TEST(SkyYear, HasALowSunWhereItStands) {
  WeatherYear weather;
  weather.hours = {{{48.86, 2.35}, {2001, 3, 21, 6.5, 1}, 500, 100},
                   {{48.86, 2.35}, {2001, 3, 21, 7.1, 1}, 500, 100}};
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
  const auto value = [&](Figure f) { return s.estimate(f).value; };
  EXPECT_NEAR(value(Figure::mean_lx), (50 + 5450 + 4000) / 3.0, 1e-3);
  EXPECT_NEAR(value(Figure::autonomy), 2.0 / 3, 1e-9);
  EXPECT_NEAR(value(Figure::continuous_autonomy), (50 / 300.0 + 2) / 3, 1e-9);
  EXPECT_NEAR(value(Figure::useful_too_low), 1.0 / 3, 1e-9);
  EXPECT_NEAR(value(Figure::useful_low), 0, 1e-9);
  EXPECT_NEAR(value(Figure::useful_enough), 0, 1e-9);
  EXPECT_NEAR(value(Figure::useful_too_high), 2.0 / 3, 1e-9);
  EXPECT_NEAR(value(Figure::sun_hours), 1, 1e-9);
  EXPECT_NEAR(value(Figure::glare_hours), 2, 1e-9);  // 5450 and 4000 lx
  EXPECT_EQ(s.melanopic, (std::vector<float>{25, 2725, 2000, 180}));
  EXPECT_NEAR(value(Figure::melanopic_250), 2.0 / 3, 1e-9);
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
  const YearEstimate mean = s.estimate(Figure::mean_lx);
  // Of one patch the sky's errors go together: 4400/3 · 0.1, and 1000/3 of the sun's.
  EXPECT_GT(mean.error, 0.5 * std::hypot(147, 333));
  EXPECT_LT(mean.error, 2 * std::hypot(147, 333));
}

TEST(YearFigures, OfAnAreaCountItsSensorsAlone) {
  const SensorYear lit = figures(0);
  SensorYear dark = lit;
  for (auto& figure : dark.figures) figure.fill(0);
  const AreaFigures area = area_figures({lit, dark, dark}, {true, true, false}, 0);
  EXPECT_NEAR(area.autonomy.value, 0.5, 1e-9);
  EXPECT_NEAR(area.mean_autonomy.value, 1.0 / 3, 1e-9);
  EXPECT_NEAR(area.sunlight.value, 0, 1e-9);  // not 250 hours
  ASSERT_EQ(area.provision.size(), 3u);
  EXPECT_NEAR(area.provision[0].target.value, 0.5, 1e-9);
  EXPECT_FALSE(area.provision[0].holds());  // 100 lx on half of the area, in place of 95 %
  EXPECT_TRUE(area_figures({lit}, {true}, 0).provision[0].holds());
}

// Two states; the sun shines in the second hour, on sensors of which one in three has enough of it.
TEST(YearFigures, BlindsCloseWhereTheSunIsOnMoreThanTwoPerCent) {
  const SkyYear year = four_hours();
  const auto state = [](std::vector<float> beams) {
    const std::size_t n = beams.size();
    return StateCoefficients{"", {}, {}, {n, 1, beams, std::vector<float>(n), {}}, {}};
  };
  const auto closed_in_hour_1 = [&](std::vector<float> open, const std::vector<bool>& in_area) {
    const std::vector<float> none(open.size());
    std::vector<StateCoefficients> both{state(none), state(open)};
    const StatesOfYear states = close_blinds(year, both, {{0, 1, 1, 1}, {0, 1, 1, 1}, 1}, {0}, in_area);
    EXPECT_EQ(both.size(), 2u);
    EXPECT_EQ(states.with_open_blinds, (std::vector<std::size_t>{0, 1, 1, 1}));
    EXPECT_EQ(states.of_hours[0], 0u);
    EXPECT_EQ(states.of_hours[2], 1u);
    return states.of_hours[1] == 0;
  };
  EXPECT_TRUE(closed_in_hour_1({0.11f, 0, 0}, {true, true, true}));    // of 10,000 lx
  EXPECT_FALSE(closed_in_hour_1({0.09f, 0, 0}, {true, true, true}));   // 900 lx
  EXPECT_FALSE(closed_in_hour_1({0.11f, 0, 0}, {false, true, true}));  // not of the area
  std::vector<float> one_in_fifty(50);
  one_in_fifty[7] = 0.5f;
  EXPECT_FALSE(closed_in_hour_1(one_in_fifty, std::vector<bool>(50, true)));  // 2 % are not more than 2 %
  one_in_fifty.pop_back();
  EXPECT_TRUE(closed_in_hour_1(one_in_fifty, std::vector<bool>(49, true)));
}

// Suns of the three hours shine through the east window, through the west window, and through both. What each
// lets in adds up; blinds leave a tenth of the sky.
TEST(YearFigures, EachGroupOfBlindsClosesByItsOwnSun) {
  SkyYear year;
  year.patches = 2;
  for (int h = 0; h < 3; ++h) {
    YearHour hour;
    hour.middle.hour = h + 9.5, hour.direct_normal_lx = 10000;
    hour.sun = year.suns.size(), hour.sky = 0;
    year.suns.push_back({0, 0, 1}), year.hours.push_back(hour);
  }
  year.luminances = {0, 1000}, year.overcast = {0, 1};
  const NearSuns near = near_suns(year.suns, 0);
  const auto state = [&](const char* name, float east, float west) {
    const auto on = [](float part) { return part == 1 ? 1.0f : 0.0f; };
    StateCoefficients c{name, coefficients({0, 0.3f * east + 0.2f * west}, {0, 0.01f}), {}, {}, {}};
    set_suns(c,
             coefficients({0.5f * on(east), 0.25f * on(west), 0.5f * on(east) + 0.25f * on(west)}, {0, 0, 0}),
             coefficients({0, 0, 0}, {0, 0, 0}), near);
    return c;
  };
  std::vector<StateCoefficients> states{state("open", 1, 1), state("east", 0.1f, 1), state("west", 1, 0.1f)};
  std::vector<StateCoefficients> traced = states;
  traced.push_back(state("east+west", 0.05f, 0.05f));
  EXPECT_EQ(close_blinds(year, traced, {{0, 0, 0}, {0, 0, 0}, 0}, {1, 2}, {true}).of_hours[2], 3u);
  EXPECT_EQ(traced.size(), 4u);
  const StatesOfYear of = close_blinds(year, states, {{0, 0, 0}, {0, 0, 0}, 0}, {1, 2}, {true});
  EXPECT_EQ(of.of_hours, (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(of.with_open_blinds, (std::vector<std::size_t>{0, 0, 0}));
  ASSERT_EQ(states.size(), 4u);
  EXPECT_EQ(states[3].name, "east+west");
  const SensorYear s = sensor_year(year, near, states, of, 0, counted_hours(year, {}), {});
  EXPECT_NEAR(s.lux[0], 1000 * (0.03 + 0.2), 1e-2);
  EXPECT_NEAR(s.lux[1], 1000 * (0.3 + 0.02), 1e-2);
  EXPECT_NEAR(s.lux[2], 1000 * (0.03 + 0.02), 1e-2);
  EXPECT_NEAR(s.melanopic[2], 500 * (0.03 + 0.02), 1e-2);
  EXPECT_NEAR(s.error[2], 1000 * 0.01 * std::sqrt(3), 1e-2);
  EXPECT_NEAR(s.estimate(Figure::sun_hours).value, 3, 1e-9);  // as with open blinds
}

// Blinds that are closed take light, but ASE counts as if they were open.
TEST(YearFigures, SunHoursAreThoseOfOpenBlinds) {
  const SkyYear year = four_hours();
  const NearSuns near = near_suns(year.suns, 3);
  StateCoefficients closed{"closed", coefficients({0, 0}, {0, 0}), {}, {}, {}};
  set_suns(closed, coefficients({0}, {0}), coefficients({0}, {0}), near);
  std::vector<StateCoefficients> both{state(near, 0), closed};
  const StatesOfYear states = close_blinds(year, both, {{0, 0, 0, 0}, {0, 0, 0, 0}, 0}, {1}, {true});
  const SensorYear s = sensor_year(year, near, both, states, 0, counted_hours(year, {}), {});
  EXPECT_EQ(s.lux, (std::vector<float>{50, 0, 4000, 360}));
  EXPECT_EQ(s.estimate(Figure::sun_hours).value, 1);
}

// Under a sky that is seen whole the factor is 1; half of the daylight hours have more than their median.
TEST(YearFigures, DaylightFactorsAnswerForTheMedianHour) {
  const SensorYear s = figures(0);
  EXPECT_NEAR(s.estimate(Figure::daylight_factor).value, 0.5, 1e-9);
  const CountedHours counted = counted_hours(four_hours(), {});
  EXPECT_EQ(median_diffuse_lx(four_hours(), counted), 4000);
  const AreaFigures area = area_figures({s}, {true}, 1000);
  EXPECT_TRUE(area.provision[1].holds_by_factor());  // 500 lx
  EXPECT_FALSE(area.provision[2].holds_by_factor());
}

TEST(Sunlight, CountsTheMinutesOfADay) {
  WeatherYear weather{{0, 0}, {{{0, 0}, {2001, 1, 1, 0.5, 0}, 0, 0}}, 0};
  // At the equator the sun of the equinox goes through the zenith, 15° an hour.
  const std::vector<Vector3d> suns = suns_of_day(weather, 3, 21, 30);
  EXPECT_NEAR(static_cast<double>(suns.size()) / 60, 8, 2.0 / 60);
  for (const Vector3d sun : suns) EXPECT_GT(sun.z, 0.5);
  Coefficients minutes{2, suns.size(), std::vector<float>(2 * suns.size()), {}, {}};
  for (std::size_t i = 0; i < suns.size(); ++i)
    minutes.mean[suns.size() + i] = static_cast<float>(std::max(0.0, suns[i].x));
  EXPECT_EQ(sunlight_hours(minutes)[0], 0);
  EXPECT_NEAR(sunlight_hours(minutes)[1], 4, 8.0 / 60);  // a window to the east, and the equation of time
  EXPECT_EQ(sunlight_level(1.49), "");
  EXPECT_EQ(sunlight_level(1.5), "minimum");
  EXPECT_EQ(sunlight_level(3), "medium");
  EXPECT_EQ(sunlight_level(4), "high");
}

// A pane to the south, which lets half of the heat in at 60° and a quarter of that from all around.
TEST(SolarHeat, IsOfTheAngleAndTheWeather) {
  SkyYear year = four_hours();
  YearHour& hour = year.hours[1];
  const SkyPatches patches(1);
  year.patches = patches.count();
  year.suns = {direction_of({60, 180})};
  hour.elevation_deg = 60;
  hour.direct_normal_w = 800, hour.diffuse_w = 100, hour.diffuse_lx = 10000, hour.global_lx = 20000;
  hour.sky = 0;
  for (const std::size_t dark : {0, 2, 3}) year.hours[dark].sky.reset();
  // One patch is lit, and the ground.
  year.luminances.assign(year.patches, 0);
  year.luminances.front() = 1000;
  year.luminances[year.patches / 4] = 2000;
  StateCoefficients c;
  std::vector<float> sky(year.patches);
  sky.front() = 1.5f, sky[year.patches / 4] = 0.01f;
  c.sky = coefficients(sky, std::vector<float>(year.patches));
  set_suns(c, coefficients({0.5f}, {0}), coefficients({0.1f}, {0}), near_suns(year.suns, 3));
  SolarGain gain;
  gain.each_10_deg.fill(0.7);
  gain.each_10_deg[6] = 0.5, gain.hemisphere = 0.25;
  const SolarHeat heat = solar_heat(year, patches, {c}, {gain}, {0, 0, 0, 0}, 0, {0, -1, 0});
  const double ground = (100 + 800 * std::sqrt(0.75)) / 20000 * 1000 * 1.5,
               patch = 100.0 / 10000 * 2000 * 0.01;
  EXPECT_NEAR(heat.on_the_pane[1], 800 * 0.6 + ground + patch, 0.01);
  const double of_patch = gain.at(dot(patches.direction(year.patches / 4, 0.5, 0.5), Vector3d{0, -1, 0}));
  EXPECT_NEAR(heat.let_in[1], 800 * (0.5 * 0.5 + 0.1 * 0.25) + ground * 0.25 + patch * of_patch, 0.01);
  EXPECT_EQ(heat.let_in[0], 0);
  EXPECT_NEAR(heat.year_kwh.value, static_cast<double>(heat.let_in[1]) / 1000, 1e-6);
  EXPECT_NEAR(gain.at(std::cos(55 * radian)), 0.6, 1e-9);
  EXPECT_EQ(gain.at(-0.1), 0.25);
}

// Under constant light the equation comes to its equilibrium; at night it fades by its rate.
TEST(SolarHeat, PhotochromicGlassFollowsItsKinetics) {
  PhotochromicLight light{{1e-5, 1e-4, 0}, 0, 0, 20, {}};
  const double uv = 20, equilibrium = 1e-5 * uv / (1e-5 * uv + 1e-4);
  std::vector<float> day(30, static_cast<float>(uv / ultraviolet_share));
  day.resize(34, 0.0f);
  std::vector<double> states;
  for (int s = 0; s <= 1000; ++s) states.push_back(s / 1000.0);
  const std::vector<std::size_t> found = photochromic_states(light, states, day);
  EXPECT_NEAR(states[found[0]], equilibrium * (1 - std::exp(-3600 * (1e-5 * uv + 1e-4))), 0.001);
  EXPECT_NEAR(states[found[29]], equilibrium, 0.001);
  EXPECT_NEAR(states[found[33]], equilibrium * std::exp(-4 * 3600 * 1e-4), 0.001);
  EXPECT_EQ(photochromic_states(light, {0, 1}, day)[29], 1u);  // the nearest of them
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
