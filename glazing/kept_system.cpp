// SPDX-License-Identifier: Apache-2.0
#include "glazing/kept_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scene/spectra/spectrum.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

using Json = nlohmann::json;

// With one more on either side, so that values between them are the same.
OpticalRows visible(const OpticalRows& rows) {
  const auto nm = [](const OpticalRow& row) { return row.nm; };
  auto first = std::ranges::upper_bound(rows, static_cast<double>(lambda_min_nm), {}, nm);
  auto end = std::ranges::lower_bound(rows, static_cast<double>(lambda_max_nm), {}, nm);
  if (first != rows.begin()) --first;
  if (end != rows.end()) ++end;
  return first < end ? OpticalRows(first, end) : rows;
}

Json to_json(const OpticalRows& rows) {
  Json json = Json::array();
  for (const OpticalRow& row : visible(rows)) json.push_back({row.nm, row.at.t, row.at.rf, row.at.rb});
  return json;
}

Json to_json(const IndexRows& rows) {
  Json json = Json::array();
  for (const IndexRow& row : rows) json.push_back({row.nm, row.n, row.k});
  return json;
}

Json to_json(const Pane& pane) {
  if (const auto* measured = std::get_if<MeasuredPane>(&pane))
    return {{"clear", measured->kind == PaneKind::clear}, {"rows", to_json(measured->rows)}};
  const auto& stack = std::get<StackPane>(pane);
  Json slabs = Json::array(), films = Json::array();
  for (const Slab& slab : stack.slabs)
    slabs.push_back({{"index", to_json(slab.index)}, {"mm", slab.thickness_mm}});
  for (const auto& between : stack.films) {
    films.push_back(Json::array());
    for (const FilmLayer& film : between)
      films.back().push_back({{"index", to_json(film.index)}, {"nm", film.thickness_nm}});
  }
  return {{"slabs", std::move(slabs)}, {"films", std::move(films)}};
}

Json to_json(const PhotochromicLight& light) {
  Json json{{"k_d", light.rates.k_d_m2_per_j},
            {"k_f", light.rates.k_f_per_s},
            {"activation", light.rates.activation_j_per_mol},
            {"start", light.start},
            {"uv", light.uv_w_per_m2},
            {"temperature", light.temperature_c}};
  if (light.seconds) json["seconds"] = *light.seconds;
  return json;
}

void require(bool condition, const char* what) {
  if (!condition) throw Error(what);
}

double fraction(const Json& json) {
  const auto value = json.get<double>();
  require(value >= 0 && value <= 1, "a fraction is not in [0, 1]");
  return value;
}

// Ascending wavelengths, at least one.
template <class Rows>
Rows checked(Rows rows) {
  require(!rows.empty(), "a table has no rows");
  for (std::size_t i = 1; i < rows.size(); ++i)
    require(rows[i - 1].nm < rows[i].nm, "wavelengths do not ascend");
  return rows;
}

OpticalRows rows_of(const Json& json) {
  OpticalRows rows;
  for (const Json& row : json)
    rows.push_back(
        {row.at(0).get<double>(), {fraction(row.at(1)), fraction(row.at(2)), fraction(row.at(3))}});
  return checked(std::move(rows));
}

IndexRows index_of(const Json& json) {
  IndexRows rows;
  for (const Json& row : json)
    rows.push_back({row.at(0).get<double>(), row.at(1).get<double>(), row.at(2).get<double>()});
  return checked(std::move(rows));
}

Pane pane_of(const Json& json) {
  if (json.contains("rows"))
    return MeasuredPane{rows_of(json["rows"]),
                        json.at("clear").get<bool>() ? PaneKind::clear : PaneKind::coated};
  StackPane stack;
  for (const Json& slab : json.at("slabs"))
    stack.slabs.push_back({index_of(slab.at("index")), slab.at("mm").get<double>()});
  for (const Json& between : json.at("films")) {
    stack.films.emplace_back();
    for (const Json& film : between)
      stack.films.back().push_back({index_of(film.at("index")), film.at("nm").get<double>()});
  }
  require(!stack.slabs.empty() && stack.films.size() == stack.slabs.size() + 1, "a stack is not whole");
  return stack;
}

PhotochromicLight light_of(const Json& json) {
  PhotochromicLight light{.rates = {json.at("k_d").get<double>(), json.at("k_f").get<double>(),
                                    json.at("activation").get<double>()},
                          .start = fraction(json.at("start")),
                          .uv_w_per_m2 = json.at("uv").get<double>(),
                          .temperature_c = json.at("temperature").get<double>()};
  if (json.contains("seconds")) light.seconds = json["seconds"].get<double>();
  return light;
}

GlazingLayer layer_of(const Json& json) {
  GlazingLayer layer{json.at("name").get<std::string>(), pane_of(json.at("pane"))};
  layer.flipped = json.at("flipped").get<bool>();
  layer.gap_behind_mm = json.at("gap_mm").get<double>();
  layer.by_temperature = json.at("by_temperature").get<bool>();
  for (const Json& state : json.at("states")) {
    layer.states.push_back({state.at("at").get<double>(), rows_of(state.at("rows"))});
    const std::size_t n = layer.states.size();
    require(n == 1 || layer.states[n - 2].at < layer.states[n - 1].at, "states do not ascend");
  }
  require(layer.states.empty() || std::holds_alternative<MeasuredPane>(layer.pane),
          "a pane of layers has states");
  if (json.contains("at")) layer.at = json["at"].get<double>();
  if (json.contains("light")) layer.light = light_of(json["light"]);
  return layer;
}

}  // namespace

std::string kept_text(const GlazingSystem& system) {
  Json layers = Json::array();
  for (const GlazingLayer& layer : system.layers) {
    Json states = Json::array();
    for (const StateRows& state : layer.states)
      states.push_back({{"at", state.at}, {"rows", to_json(state.rows)}});
    Json json{{"name", layer.name},
              {"pane", to_json(layer.pane)},
              {"flipped", layer.flipped},
              {"gap_mm", layer.gap_behind_mm},
              {"by_temperature", layer.by_temperature},
              {"states", std::move(states)}};
    if (layer.at) json["at"] = *layer.at;
    if (layer.light) json["light"] = to_json(*layer.light);
    layers.push_back(std::move(json));
  }
  const Json json{{"name", system.name}, {"layers", std::move(layers)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

GlazingSystem kept_system(const std::string& text, const std::string& file) {
  try {
    const Json json = Json::parse(text);
    GlazingSystem system{json.at("name").get<std::string>(), {}};
    for (const Json& layer : json.at("layers")) system.layers.push_back(layer_of(layer));
    require(!system.layers.empty(), "a system has no pane");
    return system;
  } catch (const std::exception& e) {
    throw Error(fmt::format("a glazing system is not as it should be: {}", e.what()), {file});
  }
}

}  // namespace vitrail
