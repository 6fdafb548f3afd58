// SPDX-License-Identifier: Apache-2.0
#include "glazing/en_673.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "glazing/gap_convection.h"

namespace vitrail {

namespace {

constexpr double mean_k = 283;
constexpr double across_all_gaps_k = 15;

double emissivity_inside(const GlazingLayer& layer) {
  return layer.flipped ? *layer.heat.emissivity_front : *layer.heat.emissivity_back;
}
double emissivity_outside(const GlazingLayer& layer) {
  return layer.flipped ? *layer.heat.emissivity_back : *layer.heat.emissivity_front;
}

double room_film(const GlazingSystem& system, double radiation) {
  return 3.6 + radiation * emissivity_inside(system.layers.back()) / 0.837;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

Resistances en_673_resistances(const GlazingSystem& system) {
  check_heat(system);
  Resistances result;
  for (const GlazingLayer& layer : system.layers)
    result.panes.push_back(layer.thickness_mm / 1000 / layer.heat.conductivity_w_mk);
  result.gaps.assign(system.layers.size() - 1, 1.0);
  for (int round = 0; round < 100; ++round) {
    const double total = sum(result.gaps);
    double change = 0;
    std::vector<double> next;
    for (std::size_t i = 0; i < result.gaps.size(); ++i) {
      const GlazingLayer &layer = system.layers[i], &behind = system.layers[i + 1];
      const double radiation = 4 * stefan_boltzmann * mean_k * mean_k * mean_k /
                               (1 / emissivity_inside(layer) + 1 / emissivity_outside(behind) - 1);
      const double gas = en_673_gap(layer.gas_behind, layer.gap_behind_mm / 1000,
                                    across_all_gaps_k * result.gaps[i] / total);
      next.push_back(1 / (radiation + gas));
      change = std::max(change, std::abs(next.back() - result.gaps[i]));
    }
    result.gaps = std::move(next);
    if (change < 1e-12) break;
  }
  return result;
}

double en_673_u_value(const GlazingSystem& system) {
  const Resistances r = en_673_resistances(system);
  return 1 / (1 / 25.0 + sum(r.panes) + sum(r.gaps) + 1 / room_film(system, 4.1));
}

double en_410_solar_factor(const GlazingSystem& system, double transmittance,
                           const std::vector<double>& absorptance) {
  const Resistances r = en_673_resistances(system);
  const std::size_t count = system.layers.size();
  double outside = 1 / 23.0, inwards = 0;
  for (std::size_t i = 0; i < count; ++i) {
    // Before and behind the place where this pane's heat starts; a single pane has no resistance.
    const double before = i == 0 ? 0 : i + 1 == count ? r.panes[i] : r.panes[i] / 2;
    outside += before;
    inwards += absorptance[i] * outside;
    if (i + 1 < count) outside += r.panes[i] - before + r.gaps[i];
  }
  return transmittance + inwards / (outside + 1 / room_film(system, 4.4));
}

}  // namespace vitrail
