// SPDX-License-Identifier: Apache-2.0
#include "glazing/system.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Two panes, the first outside.
PaneValues joined(const PaneValues& a, const PaneValues& b) {
  const double series = 1 / (1 - std::min(a.rb * b.rf, 1 - 1e-12));
  return {a.t * b.t * series, a.rf + a.t * a.t * b.rf * series, b.rb + b.t * b.t * a.rb * series};
}

PaneValues turned(const PaneValues& v, bool flipped) { return flipped ? PaneValues{v.t, v.rb, v.rf} : v; }

// Positive half of the nodes of Gauss and Legendre's rule on [−1, 1], and their weights (Abramowitz & Stegun,
// table 25.4, n = 16).
constexpr std::array<std::array<double, 2>, 8> gauss_16{{{0.0950125098376374, 0.1894506104550685},
                                                         {0.2816035507792589, 0.1826034150449236},
                                                         {0.4580167776572274, 0.1691565193950025},
                                                         {0.6178762444026438, 0.1495959888165767},
                                                         {0.7554044083550030, 0.1246289712555339},
                                                         {0.8656312023878318, 0.0951585116824928},
                                                         {0.9445750230732326, 0.0622535239386479},
                                                         {0.9894009349916499, 0.0271524594117541}}};

struct Direction {
  double cosine = 0, weight = 0;
};

std::vector<Direction> hemisphere(HemisphereRule rule) {
  std::vector<Direction> directions;
  if (rule == HemisphereRule::gauss) {
    for (const auto& [node, weight] : gauss_16)
      for (const double cosine : {(1 - node) / 2, (1 + node) / 2})
        directions.push_back({cosine, weight * cosine});
    return directions;
  }
  constexpr double step = std::numbers::pi / 18;
  for (int i = 1; i < 9; ++i) {  // the ends have no weight
    const double cosine = std::cos(i * step);
    directions.push_back({cosine, 2 * step * cosine * std::sin(i * step)});
  }
  return directions;
}

bool knows(const GlazingLayer& layer, Quantity quantity) {
  if (layer.states.empty()) return false;
  if (layer.by_temperature) return quantity == Quantity::temperature;
  return quantity == Quantity::state || layer.light.has_value();
}

}  // namespace

bool switches(const GlazingSystem& system) {
  return std::ranges::any_of(system.layers, [](const GlazingLayer& l) { return !l.states.empty(); });
}

bool set(GlazingSystem& system, Quantity quantity, double value) {
  bool any = false;
  for (GlazingLayer& layer : system.layers) {
    if (!knows(layer, quantity)) continue;
    any = true;
    if (quantity == (layer.by_temperature ? Quantity::temperature : Quantity::state)) {
      layer.at = value;
    } else {
      if (quantity == Quantity::temperature) layer.light->temperature_c = value;
      if (quantity == Quantity::uv) {
        layer.light->uv_w_per_m2 = value;
        if (layer.light->seconds == 0) layer.light->seconds.reset();  // as where none were given
      }
      if (quantity == Quantity::seconds) layer.light->seconds = value;
      layer.at = state_under(*layer.light);
    }
    std::get<MeasuredPane>(layer.pane).rows = rows_at(layer.states, *layer.at);
  }
  return any;
}

std::optional<double> value_of(const GlazingSystem& system, Quantity quantity) {
  for (const GlazingLayer& layer : system.layers) {
    if (!knows(layer, quantity)) continue;
    if (quantity == (layer.by_temperature ? Quantity::temperature : Quantity::state)) {
      if (layer.at) return layer.at;
      continue;
    }
    if (quantity == Quantity::temperature) return layer.light->temperature_c;
    if (quantity == Quantity::uv) return layer.light->uv_w_per_m2;
    return layer.light->seconds.value_or(std::numeric_limits<double>::infinity());
  }
  return {};
}

PaneValues system_values(const GlazingSystem& system, double nm, double cosine, Polarisation polarisation) {
  PolarisedValues all;
  for (std::size_t i = 0; i < system.layers.size(); ++i) {
    const GlazingLayer& layer = system.layers[i];
    PolarisedValues v = values_at(layer.pane, nm, cosine);
    if (polarisation == Polarisation::mixed_at_panes) v.s = v.p = mean(v);
    v = {turned(v.s, layer.flipped), turned(v.p, layer.flipped)};
    all = i == 0 ? v : PolarisedValues{joined(all.s, v.s), joined(all.p, v.p)};
  }
  return mean(all);
}

std::vector<double> common_wavelengths(const GlazingSystem& system) {
  std::vector<double> all;
  double first = 0, last = 1e9;
  for (const GlazingLayer& layer : system.layers) {
    const std::vector<double> nm = wavelengths_of(layer.pane);
    first = std::max(first, nm.front());
    last = std::min(last, nm.back());
    all.insert(all.end(), nm.begin(), nm.end());
  }
  constexpr double same_nm = 1e-3;  // files hold wavelengths as rounded µm
  std::erase_if(all, [&](double nm) { return nm < first - same_nm || nm > last + same_nm; });
  if (all.empty()) throw Error("the panes of a glazing have no wavelengths in common");
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return b - a < same_nm; }),
            all.end());
  return all;
}

std::string held_note(const GlazingSystem& system, double first_nm, double last_nm) {
  WavelengthRange all;
  for (const GlazingLayer& layer : system.layers) {
    all = common(all, range_of(layer.pane));
    for (const StateRows& state : layer.states) all = common(all, range_of(state.rows));
  }
  if (all.first_nm > all.last_nm) return "values are held at all wavelengths: the data have none in common";
  constexpr double rounding_nm = 0.5;
  if (all.first_nm <= first_nm + rounding_nm && all.last_nm >= last_nm - rounding_nm) return {};
  return fmt::format("values are held beyond {:g} to {:g} nm", all.first_nm, all.last_nm);
}

SystemSpectrum spectrum_at(const GlazingSystem& system, std::vector<double> nm, double cosine,
                           Polarisation polarisation) {
  SystemSpectrum spectrum{std::move(nm), {}};
  for (const double x : spectrum.nm)
    spectrum.values.push_back(system_values(system, x, cosine, polarisation));
  return spectrum;
}

SystemSpectrum hemispherical_spectrum(const GlazingSystem& system, std::vector<double> nm,
                                      Polarisation polarisation, HemisphereRule rule) {
  SystemSpectrum spectrum{std::move(nm), {}};
  const auto directions = hemisphere(rule);
  for (const double x : spectrum.nm) {
    PaneValues sum;
    for (const auto& [cosine, weight] : directions) {
      const PaneValues v = system_values(system, x, cosine, polarisation);
      sum = {sum.t + weight * v.t, sum.rf + weight * v.rf, sum.rb + weight * v.rb};
    }
    spectrum.values.push_back(sum);
  }
  return spectrum;
}

}  // namespace vitrail
