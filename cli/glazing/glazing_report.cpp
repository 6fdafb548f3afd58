// SPDX-License-Identifier: Apache-2.0
#include "cli/glazing/glazing_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace vitrail {

namespace {

using Json = nlohmann::ordered_json;

// In the order of interest; what else a standard has follows.
std::vector<std::string> method_names(const Evaluation& values) {
  std::vector<std::string> names;
  for (const char* first : {"photopic", "solar", "tuv", "tdw", "tkr"})
    if (values.averages.contains(first)) names.emplace_back(first);
  for (const auto& [name, v] : values.averages)
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

std::string color_line(const char* what, const ColorValues& c) {
  std::string line =
      fmt::format("  {:<10}{:8.3f}{:8.3f}{:8.3f}  {:8.3f}{:8.3f}{:8.3f}  {:4d}{:4d}{:4d}", what, c.xyz[0],
                  c.xyz[1], c.xyz[2], c.lab[0], c.lab[1], c.lab[2], c.rgb[0], c.rgb[1], c.rgb[2]);
  if (c.dominant_nm > 0)
    line += c.complementary_nm ? fmt::format("  purple, complementary {:.1f} nm, {:.1f} %",
                                             *c.complementary_nm, 100 * c.purity)
                               : fmt::format("  {:.1f} nm, {:.1f} %", c.dominant_nm, 100 * c.purity);
  return line + "\n";
}

std::string values_table(const Evaluation& values) {
  std::string text = fmt::format("  {:<10}{:>8}{:>9}{:>8}\n", "", "T", "R front", "R back");
  for (const std::string& name : method_names(values)) {
    const PaneValues& v = values.averages.at(name);
    text += fmt::format("  {:<10}{:8.4f}{:9.4f}{:8.4f}\n", name, v.t, v.rf, v.rb);
  }
  if (!values.has_color) return text;
  text += fmt::format("  {:<10}{:>8}{:>8}{:>8}  {:>8}{:>8}{:>8}  {:>12}  dominant wavelength, purity\n",
                      "colour", "X", "Y", "Z", "L*", "a*", "b*", "sRGB");
  return text + color_line("T", values.t) + color_line("R front", values.rf) +
         color_line("R back", values.rb);
}

Json color_json(const ColorValues& c) {
  Json json{{"X", c.xyz[0]},     {"Y", c.xyz[1]}, {"Z", c.xyz[2]}, {"L", c.lab[0]},
            {"a", c.lab[1]},     {"b", c.lab[2]}, {"rgb", c.rgb},  {"dominant_wavelength_nm", c.dominant_nm},
            {"purity", c.purity}};
  if (c.complementary_nm) json["complementary_wavelength_nm"] = *c.complementary_nm;
  return json;
}

Json result_json(const GlazingResult& result) {
  Json json;
  if (result.theta_deg)
    json["theta_deg"] = *result.theta_deg;
  else
    json["hemispherical"] = result.rule == HemisphereRule::gauss ? "integral" : "each 10 degrees";
  for (const std::string& name : method_names(result.values)) {
    const PaneValues& v = result.values.averages.at(name);
    json[name] = {{"transmittance", v.t}, {"reflectance_front", v.rf}, {"reflectance_back", v.rb}};
  }
  if (result.values.has_color)
    json["color"] = {{"transmittance", color_json(result.values.t)},
                     {"reflectance_front", color_json(result.values.rf)},
                     {"reflectance_back", color_json(result.values.rb)}};
  return json;
}

std::string title_of(const GlazingResult& result) {
  if (result.theta_deg) return fmt::format("at {:g}°", *result.theta_deg);
  return result.rule == HemisphereRule::gauss ? "hemispherical" : "hemispherical, by WinCalc's steps of 10°";
}

const char* model_of(const GlazingLayer& layer) {
  if (std::holds_alternative<StackPane>(layer.pane)) return "layers";
  return std::get<MeasuredPane>(layer.pane).kind == PaneKind::clear ? "clear" : "coated";
}

bool scatters(const GlazingLayer& layer) {
  const auto* pane = std::get_if<MeasuredPane>(&layer.pane);
  return pane && !pane->scattered.empty();
}

}  // namespace

std::string glazing_table(const GlazingReport& report) {
  std::string text;
  for (std::size_t i = 0; i < report.system.layers.size(); ++i) {
    const GlazingLayer& layer = report.system.layers[i];
    text += fmt::format("pane {}: {}, {}{}{}\n", i + 1, layer.name, model_of(layer),
                        scatters(layer) ? ", scatters" : "", layer.flipped ? ", flipped" : "");
  }
  text += fmt::format("standard: {}; sampling: {}\n", report.standard, report.sampling);
  for (const GlazingResult& result : report.results)
    text += title_of(result) + "\n" + values_table(result.values);
  return text;
}

std::string glazing_json(const GlazingReport& report) {
  Json panes = Json::array(), results = Json::array();
  for (const GlazingLayer& layer : report.system.layers)
    panes.push_back({{"name", layer.name}, {"model", model_of(layer)}, {"flipped", layer.flipped}});
  for (const GlazingResult& result : report.results) results.push_back(result_json(result));
  return Json{{"name", report.system.name},  {"panes", panes},        {"standard", report.standard},
              {"sampling", report.sampling}, {"notes", report.notes}, {"results", results}}
      .dump(1, ' ', false, Json::error_handler_t::replace);  // names of files need not be UTF-8
}

std::string glazing_csv(const std::vector<double>& theta_deg, const std::vector<SystemSpectrum>& spectra) {
  std::string text = "wavelength_nm";
  for (const double theta : theta_deg)
    text += theta_deg.size() == 1 ? ",T,Rf,Rb" : fmt::format(",T_{0:g},Rf_{0:g},Rb_{0:g}", theta);
  text += '\n';
  for (std::size_t i = 0; i < spectra.front().nm.size(); ++i) {
    text += fmt::format("{:.7g}", spectra.front().nm[i]);
    for (const SystemSpectrum& spectrum : spectra) {
      const PaneValues& v = spectrum.values[i];
      text += fmt::format(",{:.7g},{:.7g},{:.7g}", v.t, v.rf, v.rb);
    }
    text += '\n';
  }
  return text;
}

}  // namespace vitrail
