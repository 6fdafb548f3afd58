// SPDX-License-Identifier: Apache-2.0
#include "glazing/heat_balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "glazing/gap_convection.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

double black(double kelvin) { return stefan_boltzmann * kelvin * kelvin * kelvin * kelvin; }

// a x = b by elimination with the greatest pivot.
std::vector<double> solved(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t row = k + 1; row < n; ++row)
      if (std::abs(a[row][k]) > std::abs(a[pivot][k])) pivot = row;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t row = k + 1; row < n; ++row) {
      const double factor = a[row][k] / a[k][k];
      for (std::size_t column = k; column < n; ++column) a[row][column] -= factor * a[k][column];
      b[row] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t column = k + 1; column < n; ++column) b[k] -= a[k][column] * b[column];
    b[k] /= a[k][k];
  }
  return b;
}

// Surfaces count from outside: 2·pane and 2·pane + 1.
class Balance {
 public:
  Balance(const GlazingSystem& system, const HeatEnvironment& environment,
          const std::vector<double>& absorbed_w_m2, double height_m)
      : system_(system), environment_(environment), absorbed_(absorbed_w_m2), height_m_(height_m) {}

  std::size_t size() const { return 2 * system_.layers.size(); }

  // What each surface gains, W/m².
  std::vector<double> gains(const std::vector<double>& kelvin) const {
    const std::size_t count = system_.layers.size();
    std::vector<double> gain(size());
    const std::vector<double> arriving = radiation(kelvin);
    for (std::size_t i = 0; i < count; ++i) {
      const PaneHeat heat = turned(i);
      const std::size_t front = 2 * i, back = front + 1;
      const double conducted =
          heat.conductivity_w_mk / (system_.layers[i].thickness_mm / 1000) * (kelvin[back] - kelvin[front]);
      gain[front] +=
          absorbed_[i] / 2 + conducted + *heat.emissivity_front * (arriving[front] - black(kelvin[front]));
      gain[back] +=
          absorbed_[i] / 2 - conducted + *heat.emissivity_back * (arriving[back] - black(kelvin[back]));
      if (i + 1 == count) break;
      const double carried =
          iso_15099_gap(system_.layers[i].gas_behind, system_.layers[i].gap_behind_mm / 1000, height_m_,
                        kelvin[back], kelvin[back + 1]) *
          (kelvin[back + 1] - kelvin[back]);
      gain[back] += carried;
      gain[back + 1] -= carried;
    }
    gain.front() += environment_.outside_w_m2k * (environment_.outside_k - kelvin.front());
    gain.back() -= convection_into_room(kelvin);
    return gain;
  }

  double into_room(const std::vector<double>& kelvin) const {
    const PaneHeat heat = turned(system_.layers.size() - 1);
    const std::vector<double> arriving = radiation(kelvin);
    const double leaving = *heat.emissivity_back * black(kelvin.back()) +
                           heat.infrared_t * arriving[size() - 2] +
                           (1 - *heat.emissivity_back - heat.infrared_t) * arriving.back();
    return convection_into_room(kelvin) + leaving - arriving.back();
  }

 private:
  PaneHeat turned(std::size_t i) const {
    PaneHeat heat = system_.layers[i].heat;
    if (system_.layers[i].flipped) std::swap(heat.emissivity_front, heat.emissivity_back);
    return heat;
  }

  double convection_into_room(const std::vector<double>& kelvin) const {
    return iso_15099_room(height_m_, kelvin.back(), environment_.inside_k) *
           (kelvin.back() - environment_.inside_k);
  }

  // On each surface, W/m²: what the pane before it, or the one behind it, emits, lets through and reflects.
  // One linear equation a surface takes in all that goes to and fro.
  std::vector<double> radiation(const std::vector<double>& kelvin) const {
    std::vector<std::vector<double>> factors(size(), std::vector<double>(size()));
    std::vector<double> emitted(size());
    for (std::size_t i = 0; i < size(); ++i) factors[i][i] = 1;
    emitted.front() = black(environment_.outside_k);
    emitted.back() = black(environment_.inside_k);
    for (std::size_t i = 0; i < system_.layers.size(); ++i) {
      const PaneHeat heat = turned(i);
      const std::size_t front = 2 * i, back = front + 1;
      // Towards `target`, from the side that `near` lies on.
      const auto leave = [&](std::size_t target, std::size_t near, std::size_t far, double emissivity) {
        emitted[target] = emissivity * black(kelvin[near]);
        factors[target][far] -= heat.infrared_t;
        factors[target][near] -= 1 - emissivity - heat.infrared_t;
      };
      if (i > 0) leave(front - 1, front, back, *heat.emissivity_front);
      if (back + 1 < size()) leave(back + 1, back, front, *heat.emissivity_back);
    }
    return solved(std::move(factors), std::move(emitted));
  }

  const GlazingSystem& system_;
  const HeatEnvironment& environment_;
  const std::vector<double>& absorbed_;
  double height_m_;
};

double greatest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) {
    if (std::isnan(v)) return v;
    most = std::max(most, std::abs(v));
  }
  return most;
}

// Newton's step: where all gains would be 0 if they were linear.
std::vector<double> step(const Balance& balance, const std::vector<double>& kelvin,
                         const std::vector<double>& gains) {
  constexpr double small_k = 1e-4;
  std::vector<std::vector<double>> slope(kelvin.size(), std::vector<double>(kelvin.size()));
  for (std::size_t column = 0; column < kelvin.size(); ++column) {
    std::vector<double> warmer = kelvin;
    warmer[column] += small_k;
    const std::vector<double> then = balance.gains(warmer);
    for (std::size_t row = 0; row < kelvin.size(); ++row)
      slope[row][column] = (gains[row] - then[row]) / small_k;
  }
  return solved(std::move(slope), gains);
}

}  // namespace

HeatBalance heat_balance(const GlazingSystem& system, const HeatEnvironment& environment,
                         const std::vector<double>& absorbed_w_m2, double height_m) {
  check_heat(system);
  const Balance balance(system, environment, absorbed_w_m2, height_m);
  std::vector<double> kelvin(balance.size());
  for (std::size_t i = 0; i < kelvin.size(); ++i)
    kelvin[i] = environment.outside_k + (environment.inside_k - environment.outside_k) *
                                            static_cast<double>(i + 1) /
                                            static_cast<double>(kelvin.size() + 1);
  std::vector<double> gains = balance.gains(kelvin);
  constexpr double balanced_w_m2 = 1e-6;
  for (int round = 0; round < 100 && !(greatest(gains) <= balanced_w_m2); ++round) {
    const std::vector<double> change = step(balance, kelvin, gains);
    for (double part = 1; part > 1e-4; part /= 2) {
      std::vector<double> next = kelvin;
      for (std::size_t i = 0; i < next.size(); ++i) next[i] += part * change[i];
      std::vector<double> then = balance.gains(next);
      if (!(greatest(then) < greatest(gains)) && part > 2e-4) continue;
      kelvin = std::move(next);
      gains = std::move(then);
      break;
    }
  }
  if (!(greatest(gains) <= balanced_w_m2)) throw Error("the heat of this glazing comes to no balance");
  HeatBalance result{.into_room_w_m2 = balance.into_room(kelvin)};
  for (std::size_t i = 0; i < system.layers.size(); ++i)
    result.kelvin.push_back({kelvin[2 * i], kelvin[2 * i + 1]});
  return result;
}

double u_value(const GlazingSystem& system, const HeatEnvironment& environment) {
  const std::vector<double> dark(system.layers.size());
  return heat_balance(system, environment, dark).into_room_w_m2 /
         (environment.outside_k - environment.inside_k);
}

double solar_heat_gain(const GlazingSystem& system, const HeatEnvironment& environment, double transmittance,
                       const std::vector<double>& absorptance) {
  std::vector<double> absorbed = absorptance;
  for (double& a : absorbed) a *= environment.irradiance_w_m2;
  const std::vector<double> dark(system.layers.size());
  const double more = heat_balance(system, environment, absorbed).into_room_w_m2 -
                      heat_balance(system, environment, dark).into_room_w_m2;
  return transmittance + more / environment.irradiance_w_m2;
}

}  // namespace vitrail
