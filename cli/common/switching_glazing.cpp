// SPDX-License-Identifier: Apache-2.0
#include "cli/common/switching_glazing.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "glazing/kept_system.h"
#include "glazing/sheet.h"
#include "glazing/system_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

struct QuantityKind {
  Quantity quantity;
  const char* name;
  const char* unit;  // after the number
  double least, most;
  const char* range;  // in words
};
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr QuantityKind kinds[] = {
    {Quantity::state, "state", "", 0, 1, "a state is in [0, 1]"},
    {Quantity::temperature, "temperature", " °C", -273.15, infinite, "a temperature is above -273.15 °C"},
    {Quantity::uv, "uv", " W/m²", 0, infinite, "an irradiance is not negative"},
    {Quantity::seconds, "seconds", " s", 0, infinite, "a time is not negative"}};

const QuantityKind& kind_of(Quantity quantity) {
  return *std::ranges::find(kinds, quantity, &QuantityKind::quantity);
}

GlazingSetting parse_setting(const std::string& text) {
  const auto refuse = [&](const std::string& what) {
    throw UsageError(fmt::format("--set {}: {}", text, what));
  };
  const std::size_t equals = text.rfind('=');
  const std::size_t dot = equals == text.npos ? text.npos : text.rfind('.', equals);
  if (dot == text.npos || dot == 0) refuse("it has to be NAME.QUANTITY=VALUE, as in window.state=0.6");
  const std::string quantity = text.substr(dot + 1, equals - dot - 1), number = text.substr(equals + 1);
  const auto* kind = std::ranges::find(kinds, quantity, &QuantityKind::name);
  if (kind == std::end(kinds))
    refuse(
        "these can be set: scale, sun, turbidity, ground or sky of lights; color or roughness of materials; "
        "state, temperature, uv or seconds of switchable glazing");
  GlazingSetting setting{text.substr(0, dot), kind->quantity};
  const char* end = number.data() + number.size();
  const auto parsed = std::from_chars(number.data(), end, setting.value);
  if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(setting.value))
    refuse("the value has to be a number");
  if (setting.value < kind->least || setting.value > kind->most) refuse(kind->range);
  return setting;
}

// The file of a sheet of switchable glazing, with its state behind it; empty for others.
std::string switching_file(const Material& material) {
  const auto* measured = std::get_if<MeasuredMaterial>(&material.model);
  return measured && measured->sheet ? measured->filename : "";
}

std::string name_of(const Material& material, const std::string& file, const GlazingSystem& system) {
  if (!material.name.empty()) return material.name;
  if (!system.name.empty()) return system.name;
  return std::filesystem::path(file.substr(0, file.find('#'))).stem().string();
}

// A state is given, or computed from light and warmth.
void require_one_state(const std::vector<GlazingSetting>& settings, const std::string& name,
                       const GlazingSystem& system) {
  const auto is_set = [&](Quantity quantity) {
    return std::ranges::any_of(
        settings, [&](const GlazingSetting& s) { return s.name == name && s.quantity == quantity; });
  };
  const auto is_photochromic = [](const GlazingLayer& layer) { return layer.light.has_value(); };
  if (!is_set(Quantity::state) || std::ranges::none_of(system.layers, is_photochromic)) return;
  for (const Quantity other : {Quantity::temperature, Quantity::uv, Quantity::seconds})
    if (is_set(other))
      throw UsageError(
          fmt::format("--set {0}.state together with {0}.{1}: the state is given, or computed from "
                      "light and temperature; set one of the two",
                      name, kind_of(other).name));
}

// "window (state), roof (temperature)".
std::string list_of(const std::vector<KeptGlazing>& glazings, const std::filesystem::path& file) {
  std::set<std::string> words;
  for (const KeptGlazing& g : glazings)
    words.insert(fmt::format("{} ({})", g.name, names_of_quantities(kept_system(g.system, file.string()))));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::vector<KeptGlazing> switching_glazings(const Scene& scene) {
  std::vector<KeptGlazing> kept;
  std::map<std::string, std::optional<GlazingSystem>> systems;  // by file; none: it does not switch
  const auto system_of = [&](const std::string& file) -> const std::optional<GlazingSystem>& {
    const auto [found, is_new] = systems.try_emplace(file);
    if (is_new && is_glazing_file(file))
      if (GlazingSystem system = read_system({file}).system; switches(system))
        found->second = std::move(system);
    return found->second;
  };
  for (const Material& material : scene.materials) {
    const auto* sides = std::get_if<TwoSidedMaterial>(&material.model);
    if (!sides) continue;  // switchable glazing has two
    const std::string file = switching_file(scene.materials.at(sides->front.value));
    if (file.empty() || file != switching_file(scene.materials.at(sides->back.value))) continue;
    const auto& system = system_of(file);
    if (!system) continue;
    const std::string name = name_of(material, file, *system), text = kept_text(*system);
    const auto same =
        std::ranges::find_if(kept, [&](const KeptGlazing& k) { return k.name == name && k.system == text; });
    KeptGlazing& glazing = same != kept.end() ? *same : kept.emplace_back(KeptGlazing{name, {}, text});
    glazing.sheets.push_back({sides->front.value, sides->back.value});
  }
  return kept;
}

std::vector<GlazingSetting> parse_settings(const std::vector<std::string>& texts) {
  std::vector<GlazingSetting> settings;
  for (const std::string& text : texts) {
    const GlazingSetting setting = parse_setting(text);
    for (const GlazingSetting& other : settings)
      if (other.name == setting.name && other.quantity == setting.quantity)
        throw UsageError(fmt::format("--set {}: this is set twice", text));
    settings.push_back(setting);
  }
  return settings;
}

std::string describe_setting(const GlazingSystem& system) {
  std::string text;
  for (const QuantityKind& kind : kinds)
    if (const auto value = value_of(system, kind.quantity); value && std::isfinite(*value))
      text += fmt::format("{}{} {:g}{}", text.empty() ? "" : ", ", kind.name, *value, kind.unit);
  return text.empty() ? "as its product says" : text;
}

std::string names_of_quantities(const GlazingSystem& system) {
  std::string text;
  for (const QuantityKind& kind : kinds)
    if (GlazingSystem any = system; set(any, kind.quantity, 0))
      text += fmt::format("{}{}", text.empty() ? "" : ", ", kind.name);
  return text;
}

std::vector<SetSheet> sheets_under(const std::vector<GlazingSetting>& settings,
                                   const std::filesystem::path& bundle, const Manifest& manifest) {
  const std::vector<KeptGlazing> glazings = read_glazings(bundle, manifest);
  const std::filesystem::path file = glazing_path(bundle);
  std::vector<bool> used(settings.size());
  std::vector<SetSheet> sheets;
  for (const KeptGlazing& glazing : glazings) {
    GlazingSystem system = kept_system(glazing.system, file.string());
    require_one_state(settings, glazing.name, system);
    bool any = false;
    for (std::size_t i = 0; i < settings.size(); ++i)
      if (settings[i].name == glazing.name && set(system, settings[i].quantity, settings[i].value))
        any = used[i] = true;
    if (!any) continue;
    const GlazingSheets made = sheets_of(system, Polarisation::apart);
    for (const auto& [front, back] : glazing.sheets) {
      sheets.push_back({front, made.front});
      sheets.push_back({back, made.back});
    }
  }
  for (std::size_t i = 0; i < settings.size(); ++i)
    if (!used[i])
      throw UsageError(fmt::format("--set {}.{}: {}", settings[i].name, kind_of(settings[i].quantity).name,
                                   glazings.empty()
                                       ? "the scene has no switchable glazing"
                                       : "no glass has that; there is " + list_of(glazings, file)));
  return sheets;
}

}  // namespace vitrail
