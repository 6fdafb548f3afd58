// SPDX-License-Identifier: Apache-2.0
#include "glazing/system_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "glazing/json_node.h"
#include "glazing/product.h"
#include "glazing/product_formats.h"
#include "glazing/text_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;

// "FILE#state=0.6" and "FILE#temperature=40".
struct SwitchedFile {
  std::string file;
  double at = 0;
  bool by_temperature = false;
};
std::optional<SwitchedFile> switched_file(const std::string& text) {
  const std::size_t hash = text.rfind('#');
  if (hash == text.npos) return {};
  const std::string_view what = std::string_view(text).substr(hash + 1);
  for (const std::string_view name : {"state=", "temperature="})
    if (double at = 0; what.starts_with(name) && parse_number(what.substr(name.size()), at)) {
      if (name == "state=" && (at < 0 || at > 1)) throw Error("a state is in [0, 1]", {text});
      return SwitchedFile{text.substr(0, hash), at, name != "state="};
    }
  return {};
}

// Tables of measured materials are binary and large: they are not read whole to be refused.
bool may_be_text(const std::string& file) {
  std::ifstream in = open_input(file);
  std::array<char, 4096> head{};
  in.read(head.data(), head.size());
  const auto end = head.begin() + in.gcount();
  std::error_code ignored;
  return std::find(head.begin(), end, '\0') == end && fs::file_size(file, ignored) < (64u << 20);
}

class SystemReader {
 public:
  explicit SystemReader(ReadSystem& into) : into_(into) {}

  void add(const std::string& file) {
    if (const auto root = system_root(file))
      add_system(*root, fs::path(file).parent_path());
    else
      add_pane(product(file), 0);
  }

 private:
  // Of a JSON file with "layers".
  static std::optional<JsonNode> system_root(const std::string& file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return {};
    const std::string text = read_text(file);
    if (!trimmed(text).starts_with("{") || text.find("\"layers\"") == text.npos) return {};
    const JsonNode root = JsonNode::parse(text, file);
    if (!root.find("layers")) return {};
    return root;
  }

  void add_system(const JsonNode& root, const fs::path& folder) {
    root.only({"name", "layers"});
    if (into_.system.name.empty()) into_.system.name = root.text_or("name", "");
    const JsonNode layers = root.at("layers");
    bool any = false;
    for (const JsonNode& layer : layers.items()) {
      if (layer.find("gap_mm")) {
        add_gap(layer, any);
        continue;
      }
      any = true;
      if (layer.find("stack"))
        add_stack(layer, folder);
      else if (layer.find("states"))
        add_states(layer, folder);
      else
        add_pane_of(layer, folder);
      add_heat(layer);
    }
    if (!any) layers.fail("needs a pane");
  }

  void add_gap(const JsonNode& layer, bool behind_pane) {
    layer.only({"gap_mm", "gas"});
    const double mm = layer.at("gap_mm").number();
    if (!(mm > 0)) layer.fail("a gap is wider than 0");
    if (!behind_pane) layer.fail("a gap lies between two panes");
    into_.system.layers.back().gap_behind_mm = mm;
    if (const auto gas = layer.find("gas")) into_.system.layers.back().gas_behind = gas_of(*gas);
  }

  // "argon", or {"argon": 0.9, "air": 0.1}.
  static GasMixture gas_of(const JsonNode& json) {
    std::string text;
    if (json.is_text()) text = json.text();
    if (json.is_object())
      for (const auto& [name, share] : json.members())
        text += fmt::format("{}{}={}", text.empty() ? "" : ",", name, share.number());
    auto mixture = gas_mixture(text);
    if (!mixture)
      json.fail(
          "is no gas: \"air\", \"argon\", \"krypton\", \"xenon\", or shares of them that sum to 1, as in "
          "{\"argon\": 0.9, \"air\": 0.1}");
    return std::move(*mixture);
  }

  // What the file says of a pane's heat goes before what its product says.
  void add_heat(const JsonNode& layer) {
    const auto json = layer.find("heat");
    if (!json) return;
    json->only({"thickness_mm", "conductivity_w_mk", "emissivity_front", "emissivity_back", "infrared_t"});
    GlazingLayer& pane = into_.system.layers.back();
    if (json->find("thickness_mm")) pane.thickness_mm = positive_or_0(*json, "thickness_mm");
    if (json->find("conductivity_w_mk"))
      pane.heat.conductivity_w_mk = positive_or_0(*json, "conductivity_w_mk");
    if (json->find("emissivity_front")) pane.heat.emissivity_front = unit_number(*json, "emissivity_front");
    if (json->find("emissivity_back")) pane.heat.emissivity_back = unit_number(*json, "emissivity_back");
    if (json->find("infrared_t")) pane.heat.infrared_t = unit_number(*json, "infrared_t");
  }

  void add_pane_of(const JsonNode& layer, const fs::path& folder) {
    layer.only({"pane", "product", "flipped", "thickness_mm", "heat"});
    std::string file = (folder / layer.at("pane").text()).string();
    if (const auto product = layer.find("product")) file = fmt::format("{}#{}", file, product->text());
    const double mm = positive_or_0(layer, "thickness_mm");
    const Product found = product(file);
    if (mm > 0 && found.index.empty())
      layer.at("thickness_mm").fail("is for a table of n and k; clear glass takes it in a \"stack\"");
    add_pane(found, mm);
    if (const auto flipped = layer.find("flipped")) into_.system.layers.back().flipped = flipped->boolean();
  }

  static double positive_or_0(const JsonNode& json, const char* key) {
    const auto value = json.find(key);
    if (!value) return 0;
    if (!(value->number() > 0)) value->fail("has to be above 0");
    return value->number();
  }

  Product product(const std::string& file) {
    Product result = read_named_product(file);
    for (const std::string& note : result.notes) into_.notes.push_back(fmt::format("{}: {}", file, note));
    return result;
  }

  void add_pane(const Product& found, double thickness_mm) {
    into_.system.layers.push_back({found.name, pane_of(found, thickness_mm)});
    GlazingLayer& layer = into_.system.layers.back();
    layer.thickness_mm = thickness_mm > 0 ? thickness_mm : found.thickness_mm;
    layer.heat = found.heat;
    layer.by_temperature = !found.states.empty();
    for (const Product::State& state : found.states)
      layer.states.push_back({state.temperature_c, state.rows});
  }

  // Switchable glazing: its states are panes, or one is tinted from the clear one.
  void add_states(const JsonNode& layer, const fs::path& folder) {
    layer.only({"states", "state", "photochromic", "flipped", "name", "heat"});
    const JsonNode list = layer.at("states");
    GlazingLayer made{.name = layer.text_or("name", "")};
    PaneKind kind = PaneKind::clear;
    for (const JsonNode& item : list.items()) {
      item.only({"state", "pane", "product", "tinted"});
      const double at = unit_number(item, "state");
      if (!made.states.empty() && at <= made.states.back().at) item.fail("states have to ascend");
      if (const auto tint = item.find("tinted")) {
        if (made.states.empty()) tint->fail("needs a clear state before it");
        made.states.push_back({at, tinted_rows(*tint, made.states.front().rows)});
        continue;
      }
      std::string file = (folder / item.at("pane").text()).string();
      if (const auto name = item.find("product")) file = fmt::format("{}#{}", file, name->text());
      Product found = product(file);
      if (found.rows.empty()) item.fail("a state needs measured T and R");
      if (!found.scattered.empty())
        into_.notes.push_back(fmt::format("{}: scatters light; as a state all of it goes straight on", file));
      if (made.name.empty()) made.name = found.name;
      if (made.states.empty()) {
        made.thickness_mm = found.thickness_mm;
        made.heat = found.heat;
      }
      if (found.kind == PaneKind::coated) kind = PaneKind::coated;
      made.states.push_back({at, std::move(found.rows)});
    }
    if (made.states.empty()) list.fail("needs a state");
    made.light = light_of(layer);
    made.at = made.light ? state_under(*made.light) : layer.find("state") ? unit_number(layer, "state") : 0;
    made.pane = MeasuredPane{rows_at(made.states, *made.at), kind};
    if (const auto flipped = layer.find("flipped")) made.flipped = flipped->boolean();
    into_.system.layers.push_back(std::move(made));
  }

  static double unit_number(const JsonNode& json, const char* key) {
    const double value = json.at(key).number();
    if (value < 0 || value > 1) json.at(key).fail("has to be in [0, 1]");
    return value;
  }

  static std::string why_not_tinted(const OpticalRows& clear, const TintTarget& target) {
    const auto range = solar_range(clear, target.visible_t);
    if (!range)
      return fmt::format(
          "\"visible_transmittance\" is {}: it has to be above 0, and not above the clear state's",
          target.visible_t);
    if (target.solar_t < range->least || target.solar_t > range->greatest)
      return fmt::format(
          "\"solar_transmittance\" is {}: with a visible_transmittance of {} the clear state can have {:.3g} "
          "to "
          "{:.3g}",
          target.solar_t, target.visible_t, range->least, range->greatest);
    return "a clear state that reflects nothing cannot be given a \"visible_reflectance\"";
  }

  static OpticalRows tinted_rows(const JsonNode& tint, const OpticalRows& clear) {
    tint.only({"visible_transmittance", "solar_transmittance", "visible_reflectance", "band_ev"});
    TintTarget target{unit_number(tint, "visible_transmittance"), unit_number(tint, "solar_transmittance")};
    if (tint.find("visible_reflectance"))
      target.visible_reflectance = unit_number(tint, "visible_reflectance");
    if (tint.find("band_ev")) target.band_ev = positive_or_0(tint, "band_ev");
    auto rows = tinted(clear, target);
    if (!rows) tint.fail(why_not_tinted(clear, target));
    return std::move(*rows);
  }

  // Photochromic glass, and the light and warmth that the file says.
  static std::optional<PhotochromicLight> light_of(const JsonNode& layer) {
    const auto json = layer.find("photochromic");
    if (!json) return {};
    json->only(
        {"k_d_m2_per_j", "k_f_per_s", "activation_kj_per_mol", "uv_w_per_m2", "temperature_c", "seconds"});
    const auto not_negative = [&](const char* key, double otherwise) {
      const double value = json->number_or(key, otherwise);
      if (value < 0) json->fail(fmt::format("\"{}\" is negative", key));
      return value;
    };
    PhotochromicLight light{.rates = {not_negative("k_d_m2_per_j", 0), not_negative("k_f_per_s", 0),
                                      1000 * not_negative("activation_kj_per_mol", 0)},
                            .start = layer.find("state") ? unit_number(layer, "state") : 0,
                            .uv_w_per_m2 = not_negative("uv_w_per_m2", 0),
                            .temperature_c = json->number_or("temperature_c", 20)};
    if (!(light.temperature_c > -273.15)) json->fail("a temperature is above -273.15");
    // No light and no time: it stands where the file says.
    if (json->find("seconds") || (layer.find("state") && !json->find("uv_w_per_m2")))
      light.seconds = not_negative("seconds", 0);
    return light;
  }

  void add_stack(const JsonNode& layer, const fs::path& folder) {
    layer.only({"stack", "flipped", "name", "heat"});
    const JsonNode list = layer.at("stack");
    StackPane stack;
    stack.films.emplace_back();
    for (const JsonNode& part : list.items()) {
      part.only({"index", "pane", "thickness_mm", "thickness_nm"});
      const double nm = positive_or_0(part, "thickness_nm"), mm = positive_or_0(part, "thickness_mm");
      if (nm > 0) {
        stack.films.back().push_back({index_of(part, folder), nm});
      } else {
        stack.slabs.push_back(part.find("pane") ? slab_of_glass(part, folder)
                                                : Slab{index_of(part, folder), mm});
        if (!(stack.slabs.back().thickness_mm > 0))
          part.fail("needs \"thickness_mm\", or \"thickness_nm\" of a film");
        stack.films.emplace_back();
      }
    }
    if (stack.slabs.empty()) list.fail("needs a sheet: something with \"thickness_mm\"");
    GlazingLayer made{layer.text_or("name", "stack"), std::move(stack)};
    const StackPane& whole = std::get<StackPane>(made.pane);
    for (const Slab& slab : whole.slabs) made.thickness_mm += slab.thickness_mm;
    // A film of nanometres may be silver or silica; the file says its emissivity.
    if (whole.films.front().empty()) made.heat.emissivity_front = glass_emissivity;
    if (whole.films.back().empty()) made.heat.emissivity_back = glass_emissivity;
    if (const auto flipped = layer.find("flipped")) made.flipped = flipped->boolean();
    into_.system.layers.push_back(std::move(made));
  }

  IndexRows index_of(const JsonNode& part, const fs::path& folder) {
    const JsonNode index = part.at("index");
    if (!index.is_text()) {  // a transparent medium: n alone
      if (!(index.number() > 0)) index.fail("an index of refraction is above 0");
      return {{550, index.number(), 0}};
    }
    Product found = product((folder / index.text()).string());
    if (found.index.empty()) index.fail("has to name a table of n and k");
    return std::move(found.index);
  }

  // Clear glass by its measured T and R, to be laminated or coated.
  Slab slab_of_glass(const JsonNode& part, const fs::path& folder) {
    const JsonNode pane = part.at("pane");
    const Product found = product((folder / pane.text()).string());
    if (found.kind != PaneKind::clear || found.rows.empty())
      pane.fail("only clear glass can be part of a stack; this is coated, or its kind is unknown");
    const double mm =
        positive_or_0(part, "thickness_mm") > 0 ? positive_or_0(part, "thickness_mm") : found.thickness_mm;
    if (!(found.thickness_mm > 0)) pane.fail("does not say how thick it was when it was measured");
    Slab slab{{}, mm};
    for (const OpticalRow& row : found.rows)
      slab.index.push_back(
          clear_glass_index(row.nm, row.at.t, (row.at.rf + row.at.rb) / 2, found.thickness_mm));
    return slab;
  }

  ReadSystem& into_;
};

// A file with a state and a temperature behind it, each at most once.
void add_switched(const std::string& text, ReadSystem& into) {
  std::string file = text;
  std::optional<double> state, temperature_c;
  while (const auto switched = switched_file(file)) {
    auto& at = switched->by_temperature ? temperature_c : state;
    if (at) throw Error("says its state or its temperature twice", {text});
    at = switched->at;
    file = switched->file;
  }
  ReadSystem part;
  SystemReader(part).add(file);
  if ((state && !set(part.system, Quantity::state, *state)) ||
      (temperature_c && !set(part.system, Quantity::temperature, *temperature_c)))
    throw Error("no pane of it switches so", {text});
  if (into.system.name.empty()) into.system.name = part.system.name;
  into.system.layers.insert(into.system.layers.end(), part.system.layers.begin(), part.system.layers.end());
  into.notes.insert(into.notes.end(), part.notes.begin(), part.notes.end());
}

}  // namespace

bool is_glazing_file(const std::string& name) {
  constexpr int most_suffixes = 3;  // a product, a state and a temperature
  std::string file = name;
  std::error_code ignored;
  for (int suffixes = 0; !fs::is_regular_file(file, ignored); ++suffixes) {
    const std::size_t hash = file.rfind('#');
    if (hash == file.npos || suffixes == most_suffixes) return false;
    file.resize(hash);
  }
  if (!may_be_text(file)) return false;
  const std::string text = read_text(file);
  const std::string_view start = trimmed(text);
  return is_optics(text) || is_idf(text) ||
         (start.starts_with("{") &&
          (text.find("\"layers\"") != text.npos || text.find("\"spectral_data\"") != text.npos ||
           text.find("\"physical_properties\"") != text.npos));
}

ReadSystem read_system(const std::vector<std::string>& files) {
  ReadSystem result;
  for (const std::string& file : files) add_switched(file, result);
  if (result.system.layers.empty()) throw Error("a glazing needs a pane");
  return result;
}

}  // namespace vitrail
