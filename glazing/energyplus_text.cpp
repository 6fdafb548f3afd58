// SPDX-License-Identifier: Apache-2.0
#include "glazing/energyplus_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "glazing/data_sheet.h"

namespace vitrail {

namespace {

// Without what ends a field or a line in an IDF.
std::string idf_name(const std::string& text, const char* otherwise) {
  constexpr std::size_t longest = 60;  // of 100, with what is put behind it
  std::string name;
  for (const char c : text)
    name += c == ',' || c == ';' || c == '!' || static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  name.resize(std::min(name.size(), longest));
  return name.find_first_not_of(' ') == name.npos ? otherwise : name;
}

// EnergyPlus takes 800 wavelengths at most.
std::vector<double> few_wavelengths(const Pane& pane) {
  constexpr std::size_t most = 800;
  std::vector<double> nm = wavelengths_of(pane), few;
  constexpr double same_nm = 1e-3;  // files hold wavelengths as rounded µm, some twice
  std::erase_if(nm, [&](double at) { return at < 299 || at > 2501; });
  nm.erase(std::unique(nm.begin(), nm.end(), [](double a, double b) { return b - a < same_nm; }), nm.end());
  if (nm.empty()) nm = {300, 2500};
  const std::size_t step = (nm.size() + most - 1) / most;
  for (std::size_t i = 0; i < nm.size(); i += step) few.push_back(nm[i]);
  return few;
}

double millionths(double value) { return std::round(1e6 * value) / 1e6; }

std::string spectral_data(const std::string& name, const GlazingLayer& layer) {
  std::string text = fmt::format("MaterialProperty:GlazingSpectralData,\n  {}", name);
  for (const double nm : few_wavelengths(layer.pane)) {
    const PaneValues v = mean(values_at(layer.pane, nm, 1));
    const double t = millionths(v.t);  // what is rounded up may not make light of nothing
    const auto reflected = [&](double r) { return std::min(millionths(r), millionths(1 - t)); };
    text += fmt::format(",\n  {:.7g}, {:.6f}, {:.6f}, {:.6f}", nm / 1000, t,
                        reflected(layer.flipped ? v.rb : v.rf), reflected(layer.flipped ? v.rf : v.rb));
  }
  return text + ";\n\n";
}

std::string pane_text(const std::string& name, const GlazingLayer& layer) {
  const PaneHeat& heat = layer.heat;
  const double front = *heat.emissivity_front, back = *heat.emissivity_back;
  return spectral_data(name + " spectrum", layer) +
         fmt::format(
             "WindowMaterial:Glazing,\n  {0}, Spectral, {0} spectrum,\n  {1:.6g},  !- thickness, m\n"
             "  , , , , , ,\n  {2:.6g}, {3:.6g}, {4:.6g},  !- infrared transmittance, front and back "
             "emissivity\n"
             "  {5:.6g};  !- conductivity\n\n",
             name, layer.thickness_mm / 1000, heat.infrared_t, layer.flipped ? back : front,
             layer.flipped ? front : back, heat.conductivity_w_mk);
}

std::string gas_text(const std::string& name, const GlazingLayer& layer) {
  const auto capital = [](Gas gas) {
    std::string word = name_of(gas);
    word[0] = static_cast<char>(word[0] - 'a' + 'A');
    return word;
  };
  const double metres = layer.gap_behind_mm / 1000;
  const GasMixture gases = layer.gas_behind.empty() ? GasMixture{{}} : layer.gas_behind;
  if (gases.size() == 1)
    return fmt::format("WindowMaterial:Gas,\n  {}, {}, {:.6g};\n\n", name, capital(gases[0].gas), metres);
  std::string text = fmt::format("WindowMaterial:GasMixture,\n  {}, {:.6g}, {}", name, metres, gases.size());
  for (const auto& [gas, share] : gases) text += fmt::format(", {}, {:.6g}", capital(gas), share);
  return text + ";\n\n";
}

}  // namespace

std::string energyplus_text(const GlazingSystem& system) {
  check_heat(system);
  const std::string base = idf_name(system.name, "Glazing");
  const std::vector<NamedState> states = states_of(system);
  std::string materials, constructions, management;
  for (const NamedState& state : states) {
    const std::string name = state.name.empty() ? base : base + " " + idf_name(state.name, "");
    std::string layers;
    for (std::size_t i = 0; i < system.layers.size(); ++i) {
      const GlazingLayer& layer = state.system.layers[i];
      const bool first = &state == &states.front(), own = !layer.states.empty();
      const std::string pane = fmt::format("{} pane {}", own ? name : base, i + 1),
                        gap = fmt::format("{} gap {}", base, i + 1);
      const bool last = i + 1 == system.layers.size();
      if (own || first) materials += pane_text(pane, layer);
      if (first && !last) materials += gas_text(gap, layer);
      layers += ",\n  " + pane + (last ? "" : ",\n  " + gap);
    }
    constructions += fmt::format("Construction,\n  {}{};\n\n", name, layers);
    if (states.size() > 1)
      management += fmt::format("EnergyManagementSystem:ConstructionIndexVariable, Glazing_State_{}, {};\n",
                                &state - states.data() + 1, name);
  }
  if (!management.empty())
    management +=
        "\n! A program of yours switches a window, here always to the last state:\n"
        "! EnergyManagementSystem:Actuator, Window_Glazing, NAME OF THE WINDOW, Surface, Construction "
        "State;\n"
        "! EnergyManagementSystem:ProgramCallingManager, Switch, BeginTimestepBeforePredictor, "
        "Switch_Glazing;\n"
        "! EnergyManagementSystem:Program, Switch_Glazing, SET Window_Glazing = Glazing_State_" +
        fmt::format("{};\n", states.size());
  return "! Panes and constructions, from outside, by vitrail glazing.\n\n" + materials + constructions +
         management;
}

}  // namespace vitrail
