// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "cli/glazing/curve_plot.h"
#include "cli/glazing/sheet_report.h"
#include "compare/web_page.h"

namespace vitrail {

namespace {

constexpr const char* style = ".group td{font-weight:bold;padding-top:.9em}td.small{color:#555}";

std::string heading(const DataSheetState& state) {
  return state.name.empty() ? "value" : escaped(state.name);
}

std::string row(const std::string& name, const std::vector<std::string>& cells) {
  std::string text = fmt::format("<tr><td>{}", name);
  for (const std::string& cell : cells) text += "<td>" + cell;
  return text + "</tr>\n";
}

std::string number(std::optional<double> value, int digits = 3) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "–";
}

std::string panes_table(const GlazingSystem& system) {
  std::string text =
      "<h2>Panes, from outside</h2>\n<table><tr><th>pane<th>mm<th>λ, W/(m K)<th>ε outer<th>ε inner<th>gap "
      "behind</tr>\n";
  for (std::size_t i = 0; i < system.layers.size(); ++i) {
    const GlazingLayer& layer = system.layers[i];
    const bool last = i + 1 == system.layers.size();
    const auto &front = layer.flipped ? layer.heat.emissivity_back : layer.heat.emissivity_front,
               &back = layer.flipped ? layer.heat.emissivity_front : layer.heat.emissivity_back;
    text += row(fmt::format("{}. {}{}", i + 1, escaped(layer.name), layer.flipped ? ", flipped" : ""),
                {layer.thickness_mm > 0 ? fmt::format("{:.3g}", layer.thickness_mm) : "–",
                 number(layer.heat.conductivity_w_mk), number(front), number(back),
                 last ? ""
                 : layer.gap_behind_mm > 0
                     ? fmt::format("{:g} mm {}", layer.gap_behind_mm, words_for(layer.gas_behind))
                     : "–"});
  }
  return text + "</table>\n";
}

// One row of figures: the same of each state.
class FiguresTable {
 public:
  explicit FiguresTable(const DataSheet& sheet) : sheet_(sheet) {
    text_ = "<h2>Figures at normal incidence</h2>\n<table><tr><th>";
    for (const DataSheetState& state : sheet.states) text_ += "<th>" + heading(state);
    text_ += "</tr>\n";
  }
  void group(const char* name) {
    text_ += fmt::format("<tr class=group><td colspan={}>{}</tr>\n", sheet_.states.size() + 1, name);
  }
  void add(const std::string& name, const std::function<std::string(const DataSheetState&)>& cell) {
    std::vector<std::string> cells;
    for (const DataSheetState& state : sheet_.states) cells.push_back(cell(state));
    text_ += row(name, cells);
  }
  std::string text() const { return text_ + "</table>\n"; }

 private:
  const DataSheet& sheet_;
  std::string text_;
};

std::string figures_table(const DataSheet& sheet) {
  FiguresTable table(sheet);
  const auto normal = [](const DataSheetState& s) -> const AngleValues& { return s.angles.front(); };
  if (sheet.why_no_heat.empty()) {
    table.group("Heat");
    table.add("U, NFRC (ISO 15099), W/(m²K)", [](const auto& s) { return number(s.heat->u_nfrc); });
    table.add("U, EN 673, W/(m²K)", [](const auto& s) { return number(s.heat->u_en_673); });
    table.add("SHGC, NFRC (ISO 15099)", [&](const auto& s) { return number(normal(s).shgc); });
    table.add("g, EN 410", [](const auto& s) { return number(s.heat->g_en_410); });
    table.add("LSG", [&](const auto& s) { return number(normal(s).visible.t / *normal(s).shgc, 2); });
  }
  table.group("Light");
  table.add("T<sub>vis</sub>", [&](const auto& s) { return number(normal(s).visible.t, 4); });
  table.add("R<sub>vis</sub> outside", [&](const auto& s) { return number(normal(s).visible.rf, 4); });
  table.add("R<sub>vis</sub> inside", [&](const auto& s) { return number(normal(s).visible.rb, 4); });
  table.add("R<sub>a</sub>", [](const auto& s) { return number(s.color_rendering, 1); });
  table.add("R<sub>f</sub>, TM-30",
            [](const auto& s) { return s.color_fidelity ? number(s.color_fidelity->fidelity, 1) : "–"; });
  table.add("R<sub>g</sub>, TM-30",
            [](const auto& s) { return s.color_fidelity ? number(s.color_fidelity->gamut, 1) : "–"; });
  table.group("Sun");
  const auto& standards = sheet.states.front().standards;
  for (std::size_t i = 0; i < standards.size(); ++i)
    table.add("T<sub>sol</sub>, " + escaped(standards[i].standard),
              [i](const auto& s) { return number(s.standards[i].solar.t, 4); });
  table.add("R<sub>sol</sub> outside, NFRC 300-2003",
            [&](const auto& s) { return number(normal(s).solar.rf, 4); });
  for (std::size_t i = 0; i < standards.size(); ++i)
    table.add("T<sub>uv</sub>, " + escaped(standards[i].standard),
              [i](const auto& s) { return number(s.standards[i].ultraviolet_t, 4); });
  for (const PaneScattering& of : sheet.scattering) {
    table.group(fmt::format("Pane {} alone: scattered, of all that it lets through or reflects", of.pane + 1)
                    .c_str());
    const auto add = [&](const char* name, double part, double all) {
      table.add(name, [=](const auto&) { return number(part, 4) + " of " + number(all, 4); });
    };
    add("T<sub>vis</sub>", of.visible_scattered.t, of.visible.t);
    add("R<sub>vis</sub> outside", of.visible_scattered.rf, of.visible.rf);
    add("R<sub>vis</sub> inside", of.visible_scattered.rb, of.visible.rb);
    add("T<sub>sol</sub>, NFRC 300-2003", of.solar_scattered.t, of.solar.t);
    add("R<sub>sol</sub> outside, NFRC 300-2003", of.solar_scattered.rf, of.solar.rf);
  }
  return table.text();
}

std::string spectrum_plot(const DataSheet& sheet) {
  std::vector<Curve> curves;
  for (const DataSheetState& state : sheet.states) {
    const std::string color = curve_color(curves.size() / 2),
                      name = state.name.empty() ? "" : state.name + ": ";
    Curve t{name + "transmittance", color, false, {}}, r{name + "reflectance outside", color, true, {}};
    for (std::size_t i = 0; i < state.normal.nm.size(); ++i) {
      t.points.emplace_back(state.normal.nm[i], state.normal.values[i].t);
      r.points.emplace_back(state.normal.nm[i], state.normal.values[i].rf);
    }
    curves.push_back(std::move(t));
    curves.push_back(std::move(r));
  }
  return "<h2>Spectra at normal incidence</h2>\n" +
         curve_plot({"wavelength, nm", 300, 2500, 200}, {"part of the light"}, curves);
}

std::string angle_plot(const DataSheet& sheet) {
  std::vector<Curve> curves;
  for (const DataSheetState& state : sheet.states) {
    const std::string color = curve_color(curves.size() / 2),
                      name = state.name.empty() ? "" : state.name + ": ";
    Curve light{name + "light, T_vis", color, true, {}},
        sun{name + (state.heat ? "sun, SHGC" : "sun, T_sol"), color, false, {}};
    for (const AngleValues& at : state.angles) {
      if (!at.theta_deg) continue;
      light.points.emplace_back(*at.theta_deg, at.visible.t);
      sun.points.emplace_back(*at.theta_deg, at.shgc.value_or(at.solar.t));
    }
    curves.push_back(std::move(sun));
    curves.push_back(std::move(light));
  }
  return fmt::format("<h2>By angle</h2>\n<p>{}</p>\n",
                     sheet.polarisation == Polarisation::apart
                         ? "Polarisations are kept apart between panes."
                         : "At each pane the mean of both polarisations is taken, as WINDOW does.") +
         curve_plot({"angle from the normal, degrees", 0, 90, 10}, {"part of what falls on it"}, curves);
}

std::string angle_table(const DataSheetState& state) {
  std::string text = fmt::format(
      "<table><tr><th>{}<th>T<sub>vis</sub><th>R<sub>vis</sub><th>T<sub>sol</sub><th>R<sub>sol</sub>",
      state.name.empty() ? "angle" : escaped(state.name));
  for (std::size_t i = 0; i < state.angles.front().absorbed.size(); ++i)
    text += fmt::format("<th>A<sub>{}</sub>", i + 1);
  text += state.heat ? "<th>SHGC</tr>\n" : "</tr>\n";
  for (const AngleValues& at : state.angles) {
    std::vector<std::string> cells{number(at.visible.t), number(at.visible.rf), number(at.solar.t),
                                   number(at.solar.rf)};
    for (const double share : at.absorbed) cells.push_back(number(share));
    if (at.shgc) cells.push_back(number(at.shgc));
    text += row(at.theta_deg ? fmt::format("{:g}°", *at.theta_deg) : "hemisphere", cells);
  }
  return text + "</table>\n";
}

std::string temperature_table(const DataSheet& sheet) {
  if (!sheet.why_no_heat.empty())
    return fmt::format("<p>There are no figures of heat: {}.</p>\n", escaped(sheet.why_no_heat));
  std::string text =
      "<h2>Temperatures of the panes, °C</h2>\n<table><tr><th>pane<th>absorbs of the sun<th>winter, "
      "outer<th>inner<th>"
      "summer, outer<th>inner</tr>\n";
  for (const DataSheetState& state : sheet.states) {
    if (!state.name.empty())
      text += fmt::format("<tr class=group><td colspan=6>{}</tr>\n", escaped(state.name));
    for (std::size_t i = 0; i < sheet.system.layers.size(); ++i) {
      const auto &winter = state.heat->winter.kelvin[i], &summer = state.heat->summer.kelvin[i];
      text += row(fmt::format("{}. {}", i + 1, escaped(sheet.system.layers[i].name)),
                  {number(state.angles.front().absorbed[i]), number(winter[0] - freezing_k, 1),
                   number(winter[1] - freezing_k, 1), number(summer[0] - freezing_k, 1),
                   number(summer[1] - freezing_k, 1)});
    }
  }
  return text + "</table>\n";
}

constexpr const char* legend =
    "<h2>What the abbreviations mean</h2>\n<table class=words>\n"
    "<tr><td>U<td>Heat that passes from the room to outside for each m² and kelvin, at the centre of the "
    "glass. NFRC "
    "100-2010 by ISO 15099:2003: −18 °C outside, wind of 5.5 m/s, 21 °C inside, night, 1 m high. EN "
    "673:2011: "
    "15 K across the gaps at a mean of 10 °C, h<sub>e</sub> 25, h<sub>i</sub> 7.7 for plain glass.</tr>\n"
    "<tr><td>SHGC<td>Solar heat gain coefficient: the part of the sun's heat that comes into the room, "
    "through the "
    "glass or from warm panes. NFRC by ISO 15099: 32 °C outside, 24 °C inside, 783 W/m².</tr>\n"
    "<tr><td>g<td>Solar factor: the same by EN 410, with its own sun and h<sub>e</sub> 23, h<sub>i</sub> 8 "
    "for plain "
    "glass.</tr>\n"
    "<tr><td>LSG<td>Light to solar gain: T<sub>vis</sub> ÷ SHGC.</tr>\n"
    "<tr><td>T, R, A<td>Transmittance, reflectance, absorptance: parts of what falls on the outside. "
    "A<sub>1</sub> is "
    "the outermost pane's.</tr>\n"
    "<tr><td>vis<td>Light as the eye weighs it: daylight D65 and V(λ) of CIE 1931.</tr>\n"
    "<tr><td>sol<td>The sun's heat, 300 to 2500 nm. NFRC 300-2003: direct, air mass 1.5 (ASTM E891). EN "
    "410:1998: "
    "global, air mass 1. ISO 9050:2003: global, air mass 1.5 (ISO 9845-1). ISO 9050:1990: direct, air mass "
    "2.</tr>\n"
    "<tr><td>uv<td>Ultraviolet: 310 to 380 nm by NFRC, 300 to 380 nm by ISO 9050:2003, 280 to 380 nm by the "
    "others.</tr>\n"
    "<tr><td>R<sub>a</sub><td>General colour rendering index (CIE 13.3) of daylight D65 through the glass; "
    "100 changes "
    "no colour.</tr>\n"
    "<tr><td>R<sub>f</sub>, R<sub>g</sub><td>Fidelity and gamut of ANSI/IES TM-30-20, of that light against "
    "daylight or a "
    "black body of the same colour temperature; 100 changes no colour, R<sub>g</sub> above 100 is more "
    "colourful.</tr>\n"
    "<tr><td>ε, λ<td>Hemispherical emissivity of a surface; conductivity of a pane.</tr>\n"
    "<tr><td>scattered<td>What leaves a frit, etched or opal glass in all directions. The other figures "
    "count it "
    "as light that goes straight on.</tr>\n"
    "<tr><td>hemisphere<td>Light from everywhere outside alike, as under an even sky.</tr>\n"
    "<tr><td>winter, summer<td>The conditions of U (NFRC) and of SHGC at normal incidence.</tr>\n</table>\n";

}  // namespace

std::string sheet_page(const DataSheet& sheet, const std::vector<std::string>& notes) {
  const std::string title = escaped(sheet.system.name.empty() ? "Glazing" : sheet.system.name);
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=en><meta "
      "charset=utf-8><meta name=generator "
      "content=vitrail><title>{0}</title><style>{1}{2}</style>\n<h1>{0}</h1>\n",
      title, report_style, style);
  page += panes_table(sheet.system) + figures_table(sheet) + temperature_table(sheet) + spectrum_plot(sheet) +
          angle_plot(sheet);
  for (const DataSheetState& state : sheet.states) page += angle_table(state);
  page += legend;
  if (!notes.empty()) {
    page += "<h2>Notes</h2>\n<ul>\n";
    for (const std::string& note : notes) page += "<li>" + escaped(note) + "\n";
    page += "</ul>\n";
  }
  return page + "</html>\n";
}

}  // namespace vitrail
