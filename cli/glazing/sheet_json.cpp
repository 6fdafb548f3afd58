// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "cli/glazing/sheet_report.h"

namespace vitrail {

namespace {

using Json = nlohmann::ordered_json;

Json three(const PaneValues& v) {
  return {{"transmittance", v.t}, {"reflectance_front", v.rf}, {"reflectance_back", v.rb}};
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json celsius(const HeatBalance& balance) {
  Json panes = Json::array();
  for (const auto& [outer, inner] : balance.kelvin)
    panes.push_back({{"outer", outer - freezing_k}, {"inner", inner - freezing_k}});
  return panes;
}

Json angle_json(const AngleValues& at) {
  Json json;
  if (at.theta_deg)
    json["theta_deg"] = *at.theta_deg;
  else
    json["hemispherical"] = true;
  json["visible"] = three(at.visible);
  json["solar"] = three(at.solar);
  json["absorptance"] = at.absorbed;
  if (at.shgc) json["shgc"] = *at.shgc;
  return json;
}

Json state_json(const DataSheetState& state) {
  Json standards = Json::array(), angles = Json::array();
  for (const StandardValues& v : state.standards)
    standards.push_back({{"standard", v.standard},
                         {"visible", three(v.visible)},
                         {"solar", three(v.solar)},
                         {"ultraviolet_transmittance", v.ultraviolet_t}});
  for (const AngleValues& at : state.angles) angles.push_back(angle_json(at));
  Json json{{"state", state.name},
            {"standards", standards},
            {"color_rendering_index", or_null(state.color_rendering)}};
  if (state.color_fidelity)
    json["tm_30"] = {{"r_f", state.color_fidelity->fidelity},
                     {"r_g", state.color_fidelity->gamut},
                     {"color_temperature_k", state.color_fidelity->kelvin}};
  if (state.heat) {
    const double shgc = *state.angles.front().shgc;
    json["u_nfrc"] = state.heat->u_nfrc;
    json["u_en_673"] = or_null(state.heat->u_en_673);
    json["shgc"] = shgc;
    json["g_en_410"] = or_null(state.heat->g_en_410);
    json["light_to_solar_gain"] = state.angles.front().visible.t / shgc;
    json["winter_celsius"] = celsius(state.heat->winter);
    json["summer_celsius"] = celsius(state.heat->summer);
  }
  json["angles"] = angles;
  return json;
}

Json pane_json(const GlazingLayer& layer, bool last) {
  const auto& front = layer.flipped ? layer.heat.emissivity_back : layer.heat.emissivity_front;
  const auto& back = layer.flipped ? layer.heat.emissivity_front : layer.heat.emissivity_back;
  Json json{{"name", layer.name},
            {"flipped", layer.flipped},
            {"thickness_mm", layer.thickness_mm},
            {"conductivity_w_mk", layer.heat.conductivity_w_mk},
            {"emissivity_outer", or_null(front)},
            {"emissivity_inner", or_null(back)}};
  if (!last) {
    json["gap_behind_mm"] = layer.gap_behind_mm;
    json["gas_behind"] = words_for(layer.gas_behind);
  }
  return json;
}

Json scattering_json(const std::vector<PaneScattering>& panes) {
  Json json = Json::array();
  for (const PaneScattering& of : panes)
    json.push_back({{"pane", of.pane + 1},
                    {"visible", three(of.visible)},
                    {"visible_scattered", three(of.visible_scattered)},
                    {"solar", three(of.solar)},
                    {"solar_scattered", three(of.solar_scattered)}});
  return json;
}

}  // namespace

std::string sheet_json(const DataSheet& sheet, const std::vector<std::string>& notes) {
  Json panes = Json::array(), states = Json::array();
  for (const GlazingLayer& layer : sheet.system.layers)
    panes.push_back(pane_json(layer, &layer == &sheet.system.layers.back()));
  for (const DataSheetState& state : sheet.states) states.push_back(state_json(state));
  Json json{{"program", "vitrail glazing"}, {"name", sheet.system.name}, {"panes", panes}, {"notes", notes}};
  if (!sheet.why_no_heat.empty()) json["no_heat"] = sheet.why_no_heat;
  if (!sheet.scattering.empty()) json["scattering"] = scattering_json(sheet.scattering);
  json["states"] = states;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace vitrail
