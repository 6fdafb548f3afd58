// SPDX-License-Identifier: Apache-2.0
#include "glazing/data_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "glazing/color_rendering.h"
#include "glazing/en_673.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

std::vector<NamedState> states_of(const GlazingSystem& system) {
  if (!switches(system)) return {{"", system}};
  // Glass that warmth switches alone has no state to be told.
  const Quantity quantity = value_of(system, Quantity::state) ? Quantity::state : Quantity::temperature;
  std::set<double> values;
  for (const GlazingLayer& layer : system.layers)
    if (layer.by_temperature == (quantity == Quantity::temperature))
      for (const StateRows& state : layer.states) values.insert(state.at);
  if (const auto now = value_of(system, quantity)) values.insert(*now);
  std::vector<NamedState> states;
  for (const double value : values) {
    states.push_back(
        {quantity == Quantity::state ? fmt::format("state {:g}", value) : fmt::format("{:g} °C", value),
         system});
    set(states.back().system, quantity, value);
  }
  return states;
}

namespace {

// The sun's and the eye's data, without thermal radiation.
std::vector<double> wavelengths(const GlazingSystem& system) {
  std::vector<double> nm = common_wavelengths(system);
  std::erase_if(nm, [&](double at) { return at > 2501 && at != nm.front(); });
  return nm;
}

class SheetOfState {
 public:
  SheetOfState(const GlazingSystem& system, Polarisation polarisation, bool with_heat)
      : system_(system), polarisation_(polarisation), with_heat_(with_heat), nm_(wavelengths(system)) {}

  DataSheetState state(const std::string& name) const {
    DataSheetState result{.name = name, .normal = spectrum_at(system_, nm_, 1, polarisation_)};
    const std::vector<SystemSpectrum> absorbed = absorbed_spectra(system_, nm_, 1, polarisation_);
    for (const Standard* standard : {&nfrc_2003(), &en_410(), &iso_9050_2003(), &iso_9050_1990()})
      result.standards.push_back({standard->description, by(*standard, "PHOTOPIC", result.normal),
                                  by(*standard, "SOLAR", result.normal),
                                  by(*standard, "TUV", result.normal).t});
    for (int theta = 0; theta <= 90; theta += 10) result.angles.push_back(at(theta));
    result.angles.push_back(at({}));
    result.color_rendering = color_rendering_index(result.normal);
    result.color_fidelity = color_fidelity(result.normal);
    if (with_heat_) result.heat = heat(result, absorbed);
    return result;
  }

 private:
  static PaneValues by(const Standard& standard, const char* method, const SystemSpectrum& spectrum) {
    return average(spectrum, *find_method(standard, method));
  }

  static std::vector<double> absorbed_by(const Standard& standard,
                                         const std::vector<SystemSpectrum>& spectra) {
    std::vector<double> shares;
    for (const SystemSpectrum& spectrum : spectra) shares.push_back(by(standard, "SOLAR", spectrum).t);
    return shares;
  }

  AngleValues at(std::optional<double> theta_deg) const {
    std::optional<double> cosine;
    if (theta_deg) cosine = *theta_deg == 90 ? 0 : std::cos(*theta_deg * std::numbers::pi / 180);
    const SystemSpectrum spectrum =
        cosine ? spectrum_at(system_, nm_, *cosine, polarisation_)
               : hemispherical_spectrum(system_, nm_, polarisation_, HemisphereRule::gauss);
    AngleValues values{
        .theta_deg = theta_deg,
        .visible = by(nfrc_2003(), "PHOTOPIC", spectrum),
        .solar = by(nfrc_2003(), "SOLAR", spectrum),
        .absorbed = absorbed_by(nfrc_2003(), absorbed_spectra(system_, nm_, cosine, polarisation_))};
    if (with_heat_) values.shgc = solar_heat_gain(system_, nfrc_summer, values.solar.t, values.absorbed);
    return values;
  }

  HeatValues heat(const DataSheetState& state, const std::vector<SystemSpectrum>& absorbed) const {
    std::vector<double> sun = state.angles.front().absorbed;
    for (double& share : sun) share *= nfrc_summer.irradiance_w_m2;
    const std::vector<double> dark(system_.layers.size());
    HeatValues values{.u_nfrc = u_value(system_, nfrc_winter),
                      .winter = heat_balance(system_, nfrc_winter, dark),
                      .summer = heat_balance(system_, nfrc_summer, sun)};
    const bool opaque = std::ranges::all_of(
        system_.layers, [](const GlazingLayer& layer) { return layer.heat.infrared_t == 0; });
    if (!opaque) return values;
    values.u_en_673 = en_673_u_value(system_);
    values.g_en_410 =
        en_410_solar_factor(system_, by(en_410(), "SOLAR", state.normal).t, absorbed_by(en_410(), absorbed));
    return values;
  }

  const GlazingSystem& system_;
  Polarisation polarisation_;
  bool with_heat_;
  std::vector<double> nm_;
};

}  // namespace

DataSheet data_sheet(const GlazingSystem& system, Polarisation polarisation) {
  DataSheet sheet{.system = system, .polarisation = polarisation, .scattering = scattering_of(system)};
  try {
    check_heat(system);
  } catch (const Error& error) {
    sheet.why_no_heat = error.what();
  }
  for (const NamedState& state : states_of(system))
    sheet.states.push_back(
        SheetOfState(state.system, polarisation, sheet.why_no_heat.empty()).state(state.name));
  return sheet;
}

}  // namespace vitrail
