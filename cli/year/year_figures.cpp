// SPDX-License-Identifier: Apache-2.0
#include "cli/year/year_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>

#include "scene/geometry/pi.h"
#include "tracer/sampling/sampler.h"

namespace vitrail {

namespace {

constexpr std::size_t years = 1 + replicas;  // side by side; the first is the estimate
using Years = std::array<float, years>;

constexpr double enough_sun_lx = 1000, most_sun_hours = 250;  // of ASE
constexpr double glare_lx = 3473;                             // 6.22·10⁻⁵ of it + 0.184 is 0.40
constexpr double enough_melanopic_lx = 250;                   // Brown et al. 2022, by day
constexpr double most_sunlit = 0.02;                          // of the area, with open blinds
constexpr float taken_by_blinds = 0.1f;  // of the sun, at least, where it comes through them

// Normal numbers of mean 0 and variance 1 (Box & Muller 1958), a function of the seed.
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : uniform_(seed) {}
  float next() {
    const double u = 1 - uniform_.next(), v = uniform_.next();
    return static_cast<float>(std::sqrt(-2 * std::log(u)) * std::cos(2 * pi * v));
  }

 private:
  RandomStream uniform_;
};

// One sensor's coefficients of each year, side by side.
std::vector<Years> years_of(std::span<const float> mean, std::span<const float> error, std::uint64_t seed) {
  std::vector<Years> all(mean.size());
  NormalNumbers normal(seed);
  for (std::size_t i = 0; i < mean.size(); ++i) {
    all[i].fill(mean[i]);
    if (error[i] > 0)
      for (std::size_t r = 1; r < years; ++r) all[i][r] += error[i] * normal.next();
  }
  return all;
}

// Of one state, for one sensor. Patches that give nothing are left out.
struct SensorState {
  std::vector<std::uint32_t> patches;
  std::vector<Years> sky, suns;
  std::vector<float> sky_errors, melanopic;
  std::span<const float> melanopic_suns;
  std::span<const float> sun_errors, beams;

  SensorState(const StateCoefficients& c, const NearSuns& near, std::size_t sensor, std::uint64_t seed) {
    const std::vector<Years> all = years_of(c.sky.of(sensor), c.sky.errors_of(sensor), seed);
    for (std::size_t patch = 0; patch < all.size(); ++patch) {
      const float error = c.sky.errors_of(sensor)[patch];
      if (all[patch][0] == 0 && error == 0) continue;
      patches.push_back(static_cast<std::uint32_t>(patch));
      sky.push_back(all[patch]), sky_errors.push_back(error);
      melanopic.push_back(c.sky.melanopic_of(sensor)[patch]);
    }
    if (c.suns.lights == 0) return;
    beams = c.beams.of(sensor), sun_errors = c.suns.errors_of(sensor);
    melanopic_suns = c.suns.melanopic_of(sensor);
    const std::vector<Years> reflected =
        years_of(c.reflected.of(sensor), c.reflected.errors_of(sensor), mix(seed));
    suns = years_of(beams, c.beams.errors_of(sensor), mix(mix(seed)));
    for (std::size_t sun = 0; sun < near.of.size(); ++sun)
      for (const NearSuns::Near& n : near.of[sun])
        for (std::size_t r = 0; r < years; ++r) suns[sun][r] += n.weight * reflected[n.sun][r];
  }
};

struct HourLux {
  Years lux{};
  float error = 0, melanopic = 0;
};

// Whether a sensor has more than enough of the sun alone.
bool is_sunlit(const YearHour& hour, std::span<const float> beams) {
  return hour.sun && hour.direct_normal_lx * static_cast<double>(beams[*hour.sun]) > enough_sun_lx;
}

struct SkyLux {
  Years lux{};
  float variance = 0, melanopic = 0;
};

// Of some hours at once, since the coefficients are what has to be fetched. All years are added alike, so
// each set of instructions has the same bits.
constexpr std::size_t hours_at_once = 4;
[[gnu::target_clones("avx512f", "avx2", "default")]] void add_skies(
    const std::array<std::span<const float>, hours_at_once>& skies, const SensorState& state,
    std::array<SkyLux, hours_at_once>& all) {
  float lux[hours_at_once][years]{};  // by no pointer, so that they stay in registers
  for (std::size_t i = 0; i < state.patches.size(); ++i) {
    const float* const c = state.sky[i].data();
    for (std::size_t h = 0; h < hours_at_once; ++h) {
      const float luminance = skies[h][state.patches[i]], off = luminance * state.sky_errors[i];
      for (std::size_t r = 0; r < years; ++r) lux[h][r] += luminance * c[r];
      all[h].variance += off * off;
      all[h].melanopic += luminance * state.melanopic[i];
    }
  }
  for (std::size_t h = 0; h < hours_at_once; ++h) std::ranges::copy(lux[h], all[h].lux.begin());
}

// Of each hour, with the glass as it is then. Most of the time of a year's figures.
std::vector<SkyLux> sky_lux(const SkyYear& year, const std::vector<SensorState>& of_states,
                            const std::vector<std::size_t>& of_hours) {
  std::vector<SkyLux> lux(year.hours.size());
  for (std::size_t state = 0; state < of_states.size(); ++state) {
    std::vector<std::size_t> hours;
    for (std::size_t h = 0; h < year.hours.size(); ++h)
      if (year.hours[h].sky && of_hours[h] == state) hours.push_back(h);
    for (std::size_t first = 0; first < hours.size(); first += hours_at_once) {
      const auto hour = [&](std::size_t k) { return hours[std::min(first + k, hours.size() - 1)]; };
      std::array<std::span<const float>, hours_at_once> skies;
      std::array<SkyLux, hours_at_once> all{};
      for (std::size_t k = 0; k < hours_at_once; ++k) skies[k] = year.sky_of(year.hours[hour(k)]);
      add_skies(skies, of_states[state], all);
      for (std::size_t k = 0; k < hours_at_once; ++k) lux[hour(k)] = all[k];
    }
  }
  return lux;
}

HourLux hour_lux(const YearHour& hour, const SkyLux& sky, const SensorState& state) {
  if (!hour.sky) return {};
  HourLux result{sky.lux, 0, sky.melanopic};
  auto variance = static_cast<double>(sky.variance);
  if (hour.sun) {
    const auto lx = static_cast<float>(hour.direct_normal_lx);
    for (std::size_t r = 0; r < years; ++r) result.lux[r] += lx * state.suns[*hour.sun][r];
    const auto off = static_cast<double>(lx * state.sun_errors[*hour.sun]);
    variance += off * off;
    result.melanopic += lx * state.melanopic_suns[*hour.sun];
  }
  for (float& lux : result.lux) lux = std::max(lux, 0.0f);
  result.error = static_cast<float>(std::sqrt(variance));
  return result;
}

// Of the first of the values; the others tell how far it may be off.
YearEstimate estimate_of(std::span<const double> values) {
  double squares = 0;
  for (const double x : values.subspan(1)) squares += (x - values[0]) * (x - values[0]);
  return {values[0], std::sqrt(squares / static_cast<double>(values.size() - 1))};
}

}  // namespace

NearSuns near_suns(const std::vector<Vector3d>& suns, double within_deg) {
  NearSuns near;
  const double within = within_deg * radian;
  for (std::size_t i = 0; i < suns.size(); ++i) {
    std::vector<NearSuns::Near>& of = near.of.emplace_back();
    double sum = 0;
    for (std::size_t j = 0; j < suns.size(); ++j) {
      const double apart = j == i ? 0 : length(suns[j] - suns[i]);
      if (j != i && apart >= within) continue;
      const double weight = j == i ? 1 : 1 - apart / within;
      of.push_back({static_cast<std::uint32_t>(j), static_cast<float>(weight)});
      sum += weight;
    }
    for (NearSuns::Near& n : of) n.weight /= static_cast<float>(sum);
  }
  return near;
}

void set_suns(StateCoefficients& state, Coefficients beams, Coefficients reflected, const NearSuns& near) {
  state.suns = beams;
  for (std::size_t sensor = 0; sensor < beams.sensors; ++sensor)
    for (std::size_t sun = 0; sun < beams.lights; ++sun) {
      const float error = beams.errors_of(sensor)[sun];
      float mean = beams.of(sensor)[sun], variance = error * error,
            melanopic = beams.melanopic_of(sensor)[sun];
      for (const NearSuns::Near& n : near.of[sun]) {
        const float off = n.weight * reflected.errors_of(sensor)[n.sun];
        mean += n.weight * reflected.of(sensor)[n.sun], variance += off * off;
        melanopic += n.weight * reflected.melanopic_of(sensor)[n.sun];
      }
      const std::size_t place = sensor * beams.lights + sun;
      state.suns.mean[place] = mean, state.suns.error[place] = std::sqrt(variance);
      state.suns.melanopic[place] = melanopic;
    }
  state.beams = std::move(beams), state.reflected = std::move(reflected);
}

std::vector<FigureKind> figure_kinds() {
  return {{"mean_lx", "mean illuminance in the hours of use, lx"},
          {"DA", "daylight autonomy: share of the hours of use with the target or more"},
          {"cDA", "continuous daylight autonomy: hours below the target count by their share of it"},
          {"UDI_below_100", "useful daylight illuminance: share of the hours of use with less than 100 lx"},
          {"UDI_100_300", "the same, 100 to 300 lx"},
          {"UDI_300_3000", "the same, 300 to 3000 lx"},
          {"UDI_above_3000", "the same, more than 3000 lx"},
          {"sun_hours", "hours of use with more than 1000 lx of the sun alone"},
          {"daylight_100", "share of the daylight hours with 100 lx or more (EN 17037)"},
          {"daylight_300", "the same, 300 lx"},
          {"daylight_500", "the same, 500 lx"},
          {"daylight_750", "the same, 750 lx"},
          {"daylight_factor", "illuminance over that outdoors, under the overcast sky of the CIE"},
          {"glare_hours",
           "hours of use with more than 3473 lx, which at an eye is a simplified glare probability (Wienold) "
           "of 0.40"},
          {"melanopic_250", "share of the hours of use with 250 lx of melanopic EDI or more"}};
}

YearEstimate SensorYear::estimate(Figure figure) const {
  return estimate_of(figures[static_cast<std::size_t>(figure)]);
}

CountedHours counted_hours(const SkyYear& year, const FigureSettings& settings) {
  CountedHours counted;
  std::vector<std::size_t> order(year.hours.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t h) { return year.hours[h].diffuse_lx; });
  counted.daylight.resize(order.size());
  for (std::size_t i = 0; i < order.size() / 2; ++i) counted.daylight[order[i]] = true;
  for (const YearHour& hour : year.hours)
    counted.use.push_back(hour.clock_hour() >= settings.first_hour && hour.clock_hour() < settings.last_hour);
  return counted;
}

double median_diffuse_lx(const SkyYear& year, const CountedHours& counted) {
  std::vector<double> lx;
  for (std::size_t h = 0; h < year.hours.size(); ++h)
    if (counted.daylight[h]) lx.push_back(year.hours[h].diffuse_lx);
  if (lx.empty()) return 0;
  const auto middle = lx.begin() + static_cast<std::ptrdiff_t>(lx.size() / 2);
  std::ranges::nth_element(lx, middle);
  return *middle;
}

namespace {

// The coefficients with open blinds less what each of the closed groups takes away.
Coefficients together(const Coefficients& open, const std::vector<const Coefficients*>& closed) {
  Coefficients sum = open;
  const auto others = static_cast<float>(closed.size() - 1);
  for (std::size_t i = 0; i < sum.mean.size(); ++i) {
    float mean = -others * open.mean[i], melanopic = -others * open.melanopic[i],
          variance = others * others * open.error[i] * open.error[i];
    for (const Coefficients* c : closed)
      mean += c->mean[i], melanopic += c->melanopic[i], variance += c->error[i] * c->error[i];
    sum.mean[i] = mean, sum.melanopic[i] = melanopic, sum.error[i] = std::sqrt(variance);
  }
  return sum;
}

// Returns the state in which these groups are closed: where they are several, the one of their names, else
// one that is appended.
std::size_t state_with(std::vector<StateCoefficients>& states, std::size_t open,
                       const std::vector<std::size_t>& closed) {
  if (closed.size() == 1) return closed.front();
  std::string name = states[closed.front()].name;
  for (const std::size_t state : std::span(closed).subspan(1)) name += "+" + states[state].name;
  const auto traced = std::ranges::find(states, name, &StateCoefficients::name);
  if (traced != states.end()) return static_cast<std::size_t>(traced - states.begin());
  const auto sum = [&](Coefficients StateCoefficients::*part) {
    std::vector<const Coefficients*> parts;
    for (const std::size_t state : closed) parts.push_back(&(states[state].*part));
    return together(states[open].*part, parts);
  };
  states.push_back({name, sum(&StateCoefficients::sky), sum(&StateCoefficients::suns),
                    sum(&StateCoefficients::beams), sum(&StateCoefficients::reflected)});
  return states.size() - 1;
}

}  // namespace

StatesOfYear close_blinds(const SkyYear& year, std::vector<StateCoefficients>& coefficients,
                          StatesOfYear states, const std::vector<std::size_t>& closed,
                          const std::vector<bool>& in_area) {
  const auto all = static_cast<double>(std::ranges::count(in_area, true));
  for (std::size_t h = 0; h < year.hours.size(); ++h) {
    const YearHour& hour = year.hours[h];
    if (!hour.sun) continue;
    const Coefficients& beams = coefficients[states.with_open_blinds[h]].beams;
    std::vector<std::size_t> asked;
    for (const std::size_t group : closed) {
      std::size_t sunlit = 0;
      for (std::size_t s = 0; s < in_area.size(); ++s)
        sunlit +=
            in_area[s] && is_sunlit(hour, beams.of(s)) &&
            coefficients[group].beams.of(s)[*hour.sun] <= (1 - taken_by_blinds) * beams.of(s)[*hour.sun];
      if (static_cast<double>(sunlit) > most_sunlit * all) asked.push_back(group);
    }
    if (asked.empty()) continue;
    states.of_hours[h] = state_with(coefficients, states.usual, asked);
  }
  return states;
}

SensorYear sensor_year(const SkyYear& year, const NearSuns& near,
                       const std::vector<StateCoefficients>& coefficients, const StatesOfYear& states,
                       std::size_t sensor, const CountedHours& counted, const FigureSettings& settings) {
  std::vector<SensorState> of_states;
  for (const StateCoefficients& c : coefficients)
    of_states.emplace_back(c, near, sensor, mix(sensor * coefficients.size() + of_states.size()));
  SensorYear result;
  const auto figure = [&](Figure f) -> auto& { return result.figures[static_cast<std::size_t>(f)]; };
  const auto uses = static_cast<double>(std::ranges::count(counted.use, true)),
             daylight = static_cast<double>(std::ranges::count(counted.daylight, true));
  const SensorState& usual = of_states[states.usual];
  for (std::size_t i = 0; i < usual.patches.size(); ++i)
    for (std::size_t r = 0; r < years; ++r)
      figure(Figure::daylight_factor)[r] +=
          static_cast<double>(year.overcast[usual.patches[i]] * usual.sky[i][r]);
  const double a_use = uses > 0 ? 1 / uses : 0, a_daylight = daylight > 0 ? 1 / daylight : 0;
  const std::vector<SkyLux> skies = sky_lux(year, of_states, states.of_hours);
  for (std::size_t h = 0; h < year.hours.size(); ++h) {
    const HourLux lux = hour_lux(year.hours[h], skies[h], of_states[states.of_hours[h]]);
    result.lux.push_back(lux.lux[0]), result.error.push_back(lux.error);
    result.melanopic.push_back(std::max(lux.melanopic, 0.0f));
    // The other years have the hour's ratio.
    const double melanopic_of_lx =
        lux.lux[0] > 0 ? static_cast<double>(result.melanopic.back() / lux.lux[0]) : 0;
    const bool sunlit = is_sunlit(year.hours[h], of_states[states.with_open_blinds[h]].beams);
    for (std::size_t r = 0; r < years; ++r) {
      const auto lx = static_cast<double>(lux.lux[r]);
      if (counted.use[h]) {
        figure(Figure::mean_lx)[r] += lx * a_use;
        figure(Figure::autonomy)[r] += lx >= settings.target_lx ? a_use : 0;
        figure(Figure::continuous_autonomy)[r] += std::min(lx / settings.target_lx, 1.0) * a_use;
        const Figure bin = lx < 100    ? Figure::useful_too_low
                           : lx < 300  ? Figure::useful_low
                           : lx < 3000 ? Figure::useful_enough
                                       : Figure::useful_too_high;
        figure(bin)[r] += a_use;
        figure(Figure::sun_hours)[r] += sunlit ? 1 : 0;
        figure(Figure::glare_hours)[r] += lx > glare_lx ? 1 : 0;
        figure(Figure::melanopic_250)[r] += lx * melanopic_of_lx >= enough_melanopic_lx ? a_use : 0;
      }
      if (!counted.daylight[h]) continue;
      figure(Figure::daylight_100)[r] += lx >= 100 ? a_daylight : 0;
      figure(Figure::daylight_300)[r] += lx >= 300 ? a_daylight : 0;
      figure(Figure::daylight_500)[r] += lx >= 500 ? a_daylight : 0;
      figure(Figure::daylight_750)[r] += lx >= 750 ? a_daylight : 0;
    }
  }
  return result;
}

std::vector<float> lux_of_sensor(const SkyYear& year, const StateCoefficients& c, std::size_t sensor) {
  std::vector<float> lux;
  for (const YearHour& hour : year.hours) {
    double lx = 0;
    if (hour.sky) {
      const std::span<const float> sky = year.sky_of(hour), of = c.sky.of(sensor);
      for (std::size_t patch = 0; patch < sky.size(); ++patch)
        lx += static_cast<double>(sky[patch]) * static_cast<double>(of[patch]);
      if (hour.sun) lx += hour.direct_normal_lx * static_cast<double>(c.suns.of(sensor)[*hour.sun]);
    }
    lux.push_back(static_cast<float>(lx));
  }
  return lux;
}

namespace {

// The share of the counted sensors for which it holds, in each year.
YearEstimate share_of(const std::vector<SensorYear>& sensors, const std::vector<bool>& counts, Figure figure,
                      const std::function<double(double)>& of) {
  std::array<double, years> shares{};
  const auto all = static_cast<double>(std::ranges::count(counts, true));
  for (std::size_t s = 0; s < sensors.size(); ++s)
    for (std::size_t r = 0; r < years && counts[s]; ++r)
      shares[r] += of(sensors[s].figures[static_cast<std::size_t>(figure)][r]) / all;
  return estimate_of(shares);
}

}  // namespace

AreaFigures area_figures(const std::vector<SensorYear>& sensors, const std::vector<bool>& counts,
                         double median_diffuse_lx) {
  const auto half = [](double share) { return share >= 0.5 ? 1.0 : 0.0; };
  const auto share = [&](Figure figure) { return share_of(sensors, counts, figure, half); };
  const auto by_factor = [&](double lx) {
    return share_of(sensors, counts, Figure::daylight_factor,
                    [&](double factor) { return factor * median_diffuse_lx >= lx ? 1.0 : 0.0; });
  };
  AreaFigures area;
  area.autonomy = share(Figure::autonomy);
  area.sunlight = share_of(sensors, counts, Figure::sun_hours,
                           [](double hours) { return hours > most_sun_hours ? 1.0 : 0.0; });
  area.mean_autonomy = share_of(sensors, counts, Figure::autonomy, [](double da) { return da; });
  area.provision = {{"minimum", 300, 100, share(Figure::daylight_300), share(Figure::daylight_100)},
                    {"medium", 500, 300, share(Figure::daylight_500), share(Figure::daylight_300)},
                    {"high", 750, 500, share(Figure::daylight_750), share(Figure::daylight_500)}};
  for (AreaFigures::Level& level : area.provision)
    level.target_by_factor = by_factor(level.target_lx),
    level.minimum_by_factor = by_factor(level.minimum_lx);
  area.median_diffuse_lx = median_diffuse_lx;
  return area;
}

std::vector<double> sunlight_hours(const Coefficients& minutes) {
  std::vector<double> hours;
  for (std::size_t s = 0; s < minutes.sensors; ++s) {
    const std::span<const float> of = minutes.of(s);
    hours.push_back(static_cast<double>(std::ranges::count_if(of, [](float lx) { return lx > 0; })) / 60);
  }
  return hours;
}

std::string_view sunlight_level(double hours) {
  if (hours >= 4) return "high";
  if (hours >= 3) return "medium";
  return hours >= 1.5 ? "minimum" : "";
}

}  // namespace vitrail
