// SPDX-License-Identifier: Apache-2.0
#include "cli/year/solar_heat.h"

#include <algorithm>
#include <cmath>

#include "glazing/data_sheet.h"
#include "scene/geometry/pi.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

double SolarGain::at(double cosine) const {
  if (!(cosine > 0)) return hemisphere;
  const double place = std::acos(std::min(cosine, 1.0)) / radian / 10;
  const std::size_t low = std::min(static_cast<std::size_t>(place), each_10_deg.size() - 2);
  const double part = place - static_cast<double>(low);
  return each_10_deg[low] + (each_10_deg[low + 1] - each_10_deg[low]) * part;
}

SolarGain solar_gain(GlazingSystem system) {
  for (GlazingLayer& layer : system.layers) layer.states.clear(), layer.light.reset();  // one sheet is enough
  const DataSheet sheet = data_sheet(system, Polarisation::apart);
  if (!sheet.why_no_heat.empty()) throw Error("its solar heat is not known: " + sheet.why_no_heat);
  SolarGain gain;
  for (const AngleValues& values : sheet.states.front().angles) {
    if (!values.theta_deg)
      gain.hemisphere = *values.shgc;
    else
      gain.each_10_deg.at(static_cast<std::size_t>(std::lround(*values.theta_deg / 10))) = *values.shgc;
  }
  return gain;
}

SolarHeat solar_heat(const SkyYear& year, const SkyPatches& patches,
                     const std::vector<StateCoefficients>& states, const std::vector<SolarGain>& gains,
                     const std::vector<std::size_t>& of_hours, std::size_t sensor, Vector3d normal) {
  // Of each state the gain of each patch; [0] is the ground.
  std::vector<std::vector<double>> of_patches;
  for (const SolarGain& gain : gains) {
    std::vector<double>& of = of_patches.emplace_back(patches.count(), gain.hemisphere);
    for (std::size_t i = 1; i < of.size(); ++i) of[i] = gain.at(dot(patches.direction(i, 0.5, 0.5), normal));
  }
  SolarHeat result;
  std::vector<double> off(patches.count());  // what a patch's unit of error adds to the year, in W
  double sum = 0, variance = 0;
  for (std::size_t h = 0; h < year.hours.size(); ++h) {
    const YearHour& hour = year.hours[h];
    const std::size_t state = of_hours[h];
    const StateCoefficients& c = states[state];
    double on = 0, in = 0;
    if (hour.sky) {
      const double global_w =
          hour.diffuse_w + hour.direct_normal_w * std::max(0.0, std::sin(hour.elevation_deg * radian));
      const std::span<const float> sky = year.sky_of(hour), of = c.sky.of(sensor);
      for (std::size_t i = 0; i < sky.size(); ++i) {
        const double w_over_lm = i == 0 ? global_w / hour.global_lx : hour.diffuse_w / hour.diffuse_lx,
                     radiance = w_over_lm * static_cast<double>(sky[i]),
                     w = radiance * static_cast<double>(of[i]);
        on += w, in += w * of_patches[state][i];
        off[i] += radiance * of_patches[state][i] * static_cast<double>(c.sky.errors_of(sensor)[i]);
      }
    }
    if (hour.sun) {
      const double beam = static_cast<double>(c.beams.of(sensor)[*hour.sun]),
                   reflected = static_cast<double>(c.suns.of(sensor)[*hour.sun]) - beam;
      const double of_beam = gains[state].at(dot(year.suns[*hour.sun], normal));
      on += hour.direct_normal_w * (beam + reflected);
      in += hour.direct_normal_w * (beam * of_beam + reflected * gains[state].hemisphere);
      const double error =
          hour.direct_normal_w * of_beam * static_cast<double>(c.suns.errors_of(sensor)[*hour.sun]);
      variance += error * error;
    }
    result.on_the_pane.push_back(static_cast<float>(on)), result.let_in.push_back(static_cast<float>(in));
    sum += in;
  }
  for (const double error : off) variance += error * error;
  result.year_kwh = {sum / 1000, std::sqrt(variance) / 1000};
  return result;
}

std::vector<std::size_t> photochromic_states(const PhotochromicLight& light,
                                             const std::vector<double>& states,
                                             const std::vector<float>& on_the_pane_w_m2) {
  constexpr double hour_s = 3600;
  std::vector<std::size_t> of_hours;
  double s = 0;
  for (const float w : on_the_pane_w_m2) {
    s = photochromic_state(light.rates, s, ultraviolet_share * static_cast<double>(w), light.temperature_c,
                           hour_s);
    const auto nearest =
        std::ranges::min_element(states, {}, [&](double state) { return std::abs(state - s); });
    of_hours.push_back(static_cast<std::size_t>(nearest - states.begin()));
  }
  return of_hours;
}

}  // namespace vitrail
