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

PaneValues turned(const PaneValues& v, bool flipped) { return flipped ? PaneValues{v.t, v.rb, v.rf} : v; }

PolarisedValues oriented_values(const GlazingLayer& layer, double nm, double cosine,
                                Polarisation polarisation) {
  PolarisedValues v = values_at(layer.pane, nm, cosine);
  if (polarisation == Polarisation::mixed_at_panes) v.s = v.p = mean(v);
  return {turned(v.s, layer.flipped), turned(v.p, layer.flipped)};
}

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

// Of one polarisation: what a pane scatters at the normal, of all that it lets through or reflects, it
// scatters at each angle.
Streams streams_of(const PaneValues& all, const PaneValues& scatters, const PaneValues& diffuse) {
  const PaneValues scattered{all.t * scatters.t, all.rf * scatters.rf, all.rb * scatters.rb};
  return {
      {all.t - scattered.t, all.rf - scattered.rf, all.rb - scattered.rb}, scattered, scattered.t, diffuse};
}

// The parts of what the pane lets through and reflects that it scatters, at normal incidence.
PaneValues scattered_parts(const GlazingLayer& layer, double nm) {
  const auto* pane = std::get_if<MeasuredPane>(&layer.pane);
  if (!pane || pane->scattered.empty()) return {};
  const PaneValues all = value_at(pane->rows, nm), part = value_at(pane->scattered, nm);
  const auto share = [](double some, double whole) { return whole > 0 ? std::min(some / whole, 1.0) : 0; };
  return turned({share(part.t, all.t), share(part.rf, all.rf), share(part.rb, all.rb)}, layer.flipped);
}

// The sum of values(cosine) over a hemisphere, by their weights.
PaneValues summed(const std::vector<Direction>& directions, const auto& values) {
  PaneValues sum;
  for (const auto& [cosine, weight] : directions) {
    const PaneValues v = values(cosine);
    sum = {sum.t + weight * v.t, sum.rf + weight * v.rf, sum.rb + weight * v.rb};
  }
  return sum;
}

PaneValues over_hemisphere(const GlazingLayer& layer, double nm) {
  return summed(hemisphere(HemisphereRule::gauss), [&](double cosine) {
    return turned(mean(values_at(layer.pane, nm, cosine)), layer.flipped);
  });
}

// Of all panes, from outside, s and then p.
std::array<std::vector<Streams>, 2> streams_of(const GlazingSystem& system, double nm, double cosine,
                                               Polarisation polarisation) {
  std::array<std::vector<Streams>, 2> panes;
  for (const GlazingLayer& layer : system.layers) {
    const PolarisedValues v = oriented_values(layer, nm, cosine, polarisation);
    const PaneValues scatters = scattered_parts(layer, nm),
                     diffuse = scatters_light(system) ? over_hemisphere(layer, nm) : PaneValues{};
    panes[0].push_back(streams_of(v.s, scatters, diffuse));
    panes[1].push_back(streams_of(v.p, scatters, diffuse));
  }
  return panes;
}

Streams all_of(const std::vector<Streams>& panes) {
  Streams all = panes.front();
  for (std::size_t i = 1; i < panes.size(); ++i) all = joined(all, panes[i]);
  return all;
}

bool knows(const GlazingLayer& layer, Quantity quantity) {
  if (layer.states.empty()) return false;
  if (layer.by_temperature) return quantity == Quantity::temperature;
  return quantity == Quantity::state || layer.light.has_value();
}

}  // namespace

bool scatters_light(const GlazingSystem& system) {
  return std::ranges::any_of(system.layers, [](const GlazingLayer& layer) {
    const auto* pane = std::get_if<MeasuredPane>(&layer.pane);
    return pane && !pane->scattered.empty();
  });
}

void forget_scattering(GlazingSystem& system) {
  for (GlazingLayer& layer : system.layers)
    if (auto* pane = std::get_if<MeasuredPane>(&layer.pane)) pane->scattered.clear();
}

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

Streams system_streams(const GlazingSystem& system, double nm, double cosine, Polarisation polarisation) {
  const auto [of_s, of_p] = streams_of(system, nm, cosine, polarisation);
  const Streams s = all_of(of_s), p = all_of(of_p);
  return {mean({s.direct, p.direct}), mean({s.scattered, p.scattered}), (s.scattered_tb + p.scattered_tb) / 2,
          s.diffuse};
}

PaneValues system_values(const GlazingSystem& system, double nm, double cosine, Polarisation polarisation) {
  const auto [direct, scattered, scattered_tb, diffuse] = system_streams(system, nm, cosine, polarisation);
  return {direct.t + scattered.t, direct.rf + scattered.rf, direct.rb + scattered.rb};
}

std::vector<double> absorbed_shares(const GlazingSystem& system, double nm, double cosine,
                                    Polarisation polarisation) {
  const auto [s, p] = streams_of(system, nm, cosine, polarisation);
  std::vector<double> result = absorbed_by(s);
  const std::vector<double> other = absorbed_by(p);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = (result[i] + other[i]) / 2;
  return result;
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
  for (const double x : spectrum.nm)
    spectrum.values.push_back(
        summed(directions, [&](double cosine) { return system_values(system, x, cosine, polarisation); }));
  return spectrum;
}

std::vector<SystemSpectrum> absorbed_spectra(const GlazingSystem& system, const std::vector<double>& nm,
                                             std::optional<double> cosine, Polarisation polarisation) {
  const std::vector<Direction> directions =
      cosine ? std::vector<Direction>{{*cosine, 1}} : hemisphere(HemisphereRule::gauss);
  std::vector<SystemSpectrum> spectra(system.layers.size(), {nm, std::vector<PaneValues>(nm.size())});
  for (std::size_t i = 0; i < nm.size(); ++i)
    for (const auto& [direction, weight] : directions) {
      const std::vector<double> shares = absorbed_shares(system, nm[i], direction, polarisation);
      for (std::size_t pane = 0; pane < shares.size(); ++pane)
        spectra[pane].values[i].t += weight * shares[pane];
    }
  return spectra;
}

}  // namespace vitrail
