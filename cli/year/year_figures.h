// SPDX-License-Identifier: Apache-2.0
// These figures say what daylight is over a year, at each sensor and over a room.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "cli/year/coefficients.h"
#include "cli/year/sky_year.h"

namespace vitrail {

// NearSuns are suns near each sun, with weights whose sum is 1. Light of a sun that surfaces reflect is the
// mean over them. That is little less exact, as it changes slowly with the sun's place, and much less noisy.
struct NearSuns {
  struct Near {
    std::uint32_t sun = 0;
    float weight = 1;
  };
  std::vector<std::vector<Near>> of;  // each sun
};
// Weights fall from the sun itself to 0 at `within_deg`; if that is 0, each sun is alone.
NearSuns near_suns(const std::vector<Vector3d>& suns, double within_deg);

// Holds what was traced in one state of the glass. `suns` is the sum of the beams, which no surface has
// reflected, and of reflected light, the mean over near suns.
struct StateCoefficients {
  std::string name;
  Coefficients sky, suns, beams, reflected;
};
void set_suns(StateCoefficients& state, Coefficients beams, Coefficients reflected, const NearSuns& near);

// FigureSettings say which hours and which illuminance the figures count.
struct FigureSettings {
  int first_hour = 8, last_hour = 18;  // hours of use: from the first one's beginning to the last one's
  double target_lx = 300;
};

// A YearEstimate is a number and its standard error.
struct YearEstimate {
  double value = 0, error = 0;
};

// A FigureKind is a figure that each sensor has, in the order of SensorYear::figures.
struct FigureKind {
  std::string_view name;   // as tables have it
  std::string_view words;  // for people
};
std::vector<FigureKind> figure_kinds();
enum class Figure : std::size_t {
  mean_lx,
  autonomy,             // DA
  continuous_autonomy,  // cDA
  useful_too_low,       // UDI of less than 100 lx, of 100 to 300, of 300 to 3000, of more
  useful_low,
  useful_enough,
  useful_too_high,
  sun_hours,     // of use, with more than 1000 lx of the sun alone
  daylight_100,  // shares of the daylight hours of EN 17037
  daylight_300,
  daylight_500,
  daylight_750,
  daylight_factor,
  glare_hours,    // of use, in which the simplified glare probability is above 0.40
  melanopic_250,  // share of the hours of use with 250 lx of melanopic EDI
  count
};
inline constexpr std::size_t figure_count = static_cast<std::size_t>(Figure::count);

// A SensorYear is one sensor over the year. Its errors come of `replicas` years, whose coefficients
// are off by as much as theirs may be.
inline constexpr std::size_t replicas = 15;
struct SensorYear {
  std::vector<float> lux, error, melanopic;                              // an hour each, lx
  std::array<std::array<double, 1 + replicas>, figure_count> figures{};  // the first is the estimate
  YearEstimate estimate(Figure figure) const;
};

// CountedHours says whether each hour counts as one of use, and as a daylight hour. Daylight hours are the
// half that has the most light of the sky outdoors (EN 17037:2018; 4380 of a year).
struct CountedHours {
  std::vector<bool> use, daylight;
};
CountedHours counted_hours(const SkyYear& year, const FigureSettings& settings);
// Returns the illuminance of the sky on the ground that half of the daylight hours exceed.
double median_diffuse_lx(const SkyYear& year, const CountedHours& counted);

// StatesOfYear has the state of each hour. Sunlight is counted in the state that the hour has with open
// blinds, and the daylight factor is that of the state `usual`.
struct StatesOfYear {
  std::vector<std::size_t> of_hours, with_open_blinds;
  std::size_t usual = 0;
};
// Closes blinds, each group of windows by itself. In an hour a group closes where, while all are open, more
// than 2 % of the area's sensors have over 1000 lx of the sun alone through it (IES LM-83-12). `closed` holds
// for each group the state in which it alone is closed. Sun comes through the group where that state takes a
// tenth or more of it. An hour in which several close has the state of their names, "east+west". If there is
// none, it is appended to `coefficients`: that with open blinds less what each group takes away. It leaves
// out what is taken from the same light twice.
StatesOfYear close_blinds(const SkyYear& year, std::vector<StateCoefficients>& coefficients,
                          StatesOfYear states, const std::vector<std::size_t>& closed,
                          const std::vector<bool>& in_area);

SensorYear sensor_year(const SkyYear& year, const NearSuns& near,
                       const std::vector<StateCoefficients>& coefficients, const StatesOfYear& states,
                       std::size_t sensor, const CountedHours& counted, const FigureSettings& settings);
// Returns the same without errors and figures: lx of each hour.
std::vector<float> lux_of_sensor(const SkyYear& year, const StateCoefficients& coefficients,
                                 std::size_t sensor);

// AreaFigures are over the sensors of an area, all with equal weight.
struct AreaFigures {
  YearEstimate autonomy;  // sDA: share of the sensors that have the target in half of the hours of use
  YearEstimate sunlight;  // ASE: share of those that have more than 250 hours of sun
  YearEstimate mean_autonomy;
  // EN 17037's daylight provision has the levels minimum, medium, high: for each the share of sensors that
  // have the target, and the minimum target. By method 2 they have it in half of the daylight hours. By
  // method 1 their daylight factors are large enough that they have it at `median_diffuse_lx` outdoors.
  struct Level {
    std::string_view name;
    double target_lx, minimum_lx;
    YearEstimate target, minimum, target_by_factor, minimum_by_factor;
    bool holds() const { return target.value >= 0.5 && minimum.value >= 0.95; }
    bool holds_by_factor() const { return target_by_factor.value >= 0.5 && minimum_by_factor.value >= 0.95; }
  };
  std::vector<Level> provision;
  double median_diffuse_lx = 0;
};
AreaFigures area_figures(const std::vector<SensorYear>& sensors, const std::vector<bool>& counts,
                         double median_diffuse_lx);

// Returns EN 17037's exposure to sunlight of each sensor: the hours of a day in which it gets sun. They come
// of the coefficients of the day's minutes (suns_of_day).
std::vector<double> sunlight_hours(const Coefficients& minutes);
// Returns the level that so many hours reach; empty below the first.
std::string_view sunlight_level(double hours);

}  // namespace vitrail
