// SPDX-License-Identifier: Apache-2.0
#include "glazing/states.h"

#include <algorithm>
#include <cmath>

#include "glazing/evaluation.h"
#include "scene/geometry/portable_math.h"
#include "scene/spectra/color.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

namespace {

double absorbance_mix(double a, double b, double w) {
  constexpr double dark = 1e-6;  // below what is measured
  if (std::max(a, b) < dark) return a + w * (b - a);
  return portable_exp((1 - w) * portable_log(std::max(a, dark)) + w * portable_log(std::max(b, dark)));
}

PaneValues mix(const PaneValues& a, const PaneValues& b, double w) {
  return {absorbance_mix(a.t, b.t, w), a.rf + w * (b.rf - a.rf), a.rb + w * (b.rb - a.rb)};
}

OpticalRows mix(const OpticalRows& a, const OpticalRows& b, double w) {
  std::vector<double> nm;
  for (const OpticalRows* rows : {&a, &b})
    for (const OpticalRow& row : *rows) nm.push_back(row.nm);
  std::ranges::sort(nm);
  nm.erase(std::unique(nm.begin(), nm.end()), nm.end());
  OpticalRows result;
  for (const double x : nm) result.push_back({x, mix(value_at(a, x), value_at(b, x), w)});
  return result;
}

// ---- a band of absorption

double band(double nm, double centre_ev, double width_ev) {
  constexpr double ev_nm = 1239.841984;  // h·c/e
  const double x = (ev_nm / nm - centre_ev) / width_ev;
  return portable_exp(-0.5 * x * x);
}

// At steps that a band needs, whatever those of the clear state.
OpticalRows resampled(const OpticalRows& rows) {
  OpticalRows fine;
  for (double nm = 300; nm <= 2500; nm += 5) fine.push_back({nm, value_at(rows, nm)});
  return fine;
}

// How strong either absorption is, and how wide the band.
struct Absorption {
  double width_ev = 0, band = 0, free = 0;
};

// Free electrons absorb as λ² (Drude); from the end of the visible on, so that they leave T_vis as it is.
double free_absorbance(double nm) { return nm > 780 ? nm * nm / (780.0 * 780.0) - 1 : 0; }

OpticalRows absorbed(const OpticalRows& clear, double centre_ev, const Absorption& a) {
  OpticalRows rows = clear;
  for (OpticalRow& row : rows)
    row.at.t *=
        portable_exp(-a.band * band(row.nm, centre_ev, a.width_ev) - a.free * free_absorbance(row.nm));
  return rows;
}

PaneValues average_of(const OpticalRows& rows, const char* method) {
  SystemSpectrum spectrum;
  for (const OpticalRow& row : rows) {
    spectrum.nm.push_back(row.nm);
    spectrum.values.push_back(row.at);
  }
  return average(spectrum, *find_method(nfrc_2003(), method));
}

// Where f, which falls from above 0 to below it, is 0; `low` and `high` hold it.
double root(double low, double high, auto f) {
  for (int i = 0; i < 45; ++i) {
    const double middle = (low + high) / 2;
    (f(middle) > 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

// The band of this width that has T_vis, and the free electrons that then have T_sol; nothing where they
// cannot.
std::optional<OpticalRows> with_width(const OpticalRows& clear, const TintTarget& target, double width_ev) {
  Absorption a{.width_ev = width_ev};
  const auto missed = [&](const char* method, double wanted) {
    return average_of(absorbed(clear, target.band_ev, a), method).t - wanted;
  };
  a.band = root(0, 1e4, [&](double x) { return a.band = x, missed("PHOTOPIC", target.visible_t); });
  a.free = 0;
  if (missed("SOLAR", target.solar_t) < 0) return std::nullopt;
  a.free = root(0, 1e4, [&](double x) { return a.free = x, missed("SOLAR", target.solar_t); });
  if (std::abs(missed("PHOTOPIC", 0) - target.visible_t) > 1e-3 * target.visible_t) return std::nullopt;
  if (std::abs(missed("SOLAR", 0) - target.solar_t) > 1e-3 * target.solar_t) return std::nullopt;
  return absorbed(clear, target.band_ev, a);
}

// ---- any spectrum at all

// The eye's, V(λ), to the nanometre; 1 at most.
double sensitivity(double nm) {
  const double at = std::round(nm - lambda_min_nm);
  if (at < 0 || at > table_size - 1) return 0;
  return std::min(static_cast<double>(cie_1931()[static_cast<std::size_t>(at)][1]), 1.0);
}

// Absorbance: what light and the rest of the spectrum have of it.
struct Split {
  double seen = 0, unseen = 0;
};

OpticalRows absorbed(const OpticalRows& clear, const Split& a) {
  OpticalRows rows = clear;
  for (OpticalRow& row : rows) {
    const double v = sensitivity(row.nm);
    row.at.t *= portable_exp(-a.seen * v - a.unseen * (1 - v));
  }
  return rows;
}

// Of the unseen: then 6·10⁻⁶ of it are left, and a band around 555 nm that is not narrower than 29 nm.
constexpr double most_absorbance = 12;

// That has T_vis, with so much of the unseen: the less light for it the more is absorbed elsewhere.
OpticalRows with_light(const OpticalRows& clear, double visible_t, double unseen) {
  const double seen = root(0, 1e4, [&](double x) {
    return average_of(absorbed(clear, Split{x, unseen}), "PHOTOPIC").t - visible_t;
  });
  return absorbed(clear, Split{seen, unseen});
}

// The most of the unseen that leaves T_vis.
double most_unseen(const OpticalRows& clear, double visible_t) {
  return root(0, most_absorbance, [&](double x) {
    return average_of(absorbed(clear, Split{0, x}), "PHOTOPIC").t - visible_t;
  });
}

OpticalRows with_averages(const OpticalRows& clear, const TintTarget& target) {
  const double unseen = root(0, most_unseen(clear, target.visible_t), [&](double x) {
    return average_of(with_light(clear, target.visible_t, x), "SOLAR").t - target.solar_t;
  });
  return with_light(clear, target.visible_t, unseen);
}

std::optional<SolarRange> range_of(const OpticalRows& clear, double visible_t) {
  if (!(visible_t > 0) || visible_t > average_of(clear, "PHOTOPIC").t) return std::nullopt;
  const auto solar = [&](double unseen) {
    return average_of(with_light(clear, visible_t, unseen), "SOLAR").t;
  };
  return SolarRange{solar(most_unseen(clear, visible_t)), solar(0)};
}

std::optional<OpticalRows> spectrum_for(const OpticalRows& clear, const TintTarget& target) {
  for (double width_ev = 0.5; width_ev < 5; width_ev *= 1.15)
    if (auto rows = with_width(clear, target, width_ev)) return rows;
  const auto range = range_of(clear, target.visible_t);
  if (!range || target.solar_t < range->least || target.solar_t > range->greatest) return std::nullopt;
  return with_averages(clear, target);
}

}  // namespace

OpticalRows rows_at(const std::vector<StateRows>& states, double at) {
  const auto above = std::ranges::upper_bound(states, at, {}, &StateRows::at);
  if (above == states.begin()) return states.front().rows;
  if (above == states.end()) return states.back().rows;
  const StateRows &a = *(above - 1), &b = *above;
  return mix(a.rows, b.rows, (at - a.at) / (b.at - a.at));
}

std::optional<SolarRange> solar_range(const OpticalRows& clear, double visible_t) {
  return range_of(resampled(clear), visible_t);
}

std::optional<OpticalRows> tinted(const OpticalRows& clear, const TintTarget& target) {
  const OpticalRows fine = resampled(clear);
  auto rows = spectrum_for(fine, target);
  if (!rows || !target.visible_reflectance) return rows;
  const PaneValues now = average_of(fine, "PHOTOPIC");
  if (!(std::min(now.rf, now.rb) > 0)) return std::nullopt;
  for (OpticalRow& row : *rows) {
    row.at.rf = std::min(row.at.rf * *target.visible_reflectance / now.rf, 1 - row.at.t);
    row.at.rb = std::min(row.at.rb * *target.visible_reflectance / now.rb, 1 - row.at.t);
  }
  return rows;
}

double fading_per_s(const Photochromic& p, double temperature_c) {
  constexpr double gas_j_per_mol_k = 8.314462618, zero_k = 273.15;
  const double inverse = 1 / (temperature_c + zero_k) - 1 / (20 + zero_k);
  return p.k_f_per_s * portable_exp(-p.activation_j_per_mol / gas_j_per_mol_k * inverse);
}

double photochromic_equilibrium(const Photochromic& p, double uv_w_per_m2, double temperature_c) {
  const double darkening = p.k_d_m2_per_j * uv_w_per_m2, rate = darkening + fading_per_s(p, temperature_c);
  return rate > 0 ? darkening / rate : 0;
}

double photochromic_state(const Photochromic& p, double s, double uv_w_per_m2, double temperature_c,
                          double seconds) {
  const double rate = p.k_d_m2_per_j * uv_w_per_m2 + fading_per_s(p, temperature_c);
  if (!(rate > 0)) return s;
  const double end = photochromic_equilibrium(p, uv_w_per_m2, temperature_c);
  return end + (s - end) * portable_exp(-rate * seconds);
}

double state_under(const PhotochromicLight& light) {
  if (!light.seconds) return photochromic_equilibrium(light.rates, light.uv_w_per_m2, light.temperature_c);
  return photochromic_state(light.rates, light.start, light.uv_w_per_m2, light.temperature_c, *light.seconds);
}

}  // namespace vitrail
