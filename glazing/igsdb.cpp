// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "glazing/json_node.h"
#include "glazing/product_formats.h"
#include "glazing/text_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Version 2 writes many of its numbers as text.
double number_of(const JsonNode& json) {
  if (!json.is_text()) return json.number();
  double value = 0;
  if (!parse_number(trimmed(json.text()), value)) json.fail("has to be a number");
  return value;
}

// Any of the spellings that versions of the database have used.
double column(const JsonNode& row, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const auto value = row.find(name)) return value->number();
  row.fail(fmt::format("needs \"{}\"", *names.begin()));
}

// Some exports nest the list in an object of the same name.
JsonNode row_list(const JsonNode& product) {
  const JsonNode data = product.at("spectral_data");
  return data.is_array() ? data : data.at("spectral_data");
}

PaneKind kind_of(const JsonNode& product) {
  const std::string subtype = lower(product.text_or("subtype", product.text_or("type", "")));
  const std::string side = lower(product.text_or("coated_side", "neither"));
  const bool bare = side == "neither" || side == "na" || side == "n/a" || side.empty();
  return subtype == "monolithic" && bare ? PaneKind::clear : PaneKind::coated;
}

// Blinds, shades, frames' materials and photovoltaic layers have spectra too, of what they are made of.
// Versions before 2 have a glazing's subtype as its type.
bool is_glazing(const JsonNode& product) {
  const std::string type = lower(product.text_or("type", "glazing")),
                    subtype = lower(product.text_or("subtype", ""));
  for (const char* other :
       {"shad", "blind", "louver", "weave", "woven", "perforated", "material", "photovoltaic", "pv"})
    for (const std::string& word : {type, subtype})
      if (word.find(other) != word.npos) return false;
  return true;
}

PaneHeat heat_of(const JsonNode& measured) {
  PaneHeat heat;
  const auto fraction = [&](const std::string& key) -> std::optional<double> {
    const auto value = measured.find(key) ? measured.find(key) : measured.find("predefined_" + key);
    if (!value) return {};
    const double known = number_of(*value);
    if (!(known >= 0 && known <= 1)) value->fail("has to be in [0, 1]");
    return known;
  };
  heat.emissivity_front = fraction("emissivity_front");
  heat.emissivity_back = fraction("emissivity_back");
  heat.infrared_t = fraction("tir_front").value_or(0);
  // 0 stands where it was not measured.
  if (const auto known = measured.find("conductivity"); known && number_of(*known) > 0)
    heat.conductivity_w_mk = number_of(*known);
  return heat;
}

void add_rows(const JsonNode& list, Product& product) {
  OpticalRows rows;
  for (const JsonNode& row : list.items()) {
    // Diffuse columns, and bands without a value, carry no specular row.
    if (!row.find("T") && !row.find("tf") && !row.find("Tf")) continue;
    rows.push_back({column(row, {"wavelength"}) * 1000,
                    {column(row, {"T", "tf", "Tf"}), column(row, {"Rf", "rf"}), column(row, {"Rb", "rb"})}});
  }
  if (rows.empty()) list.fail("has no rows with \"T\"");
  try {
    product.rows = checked_rows(std::move(rows), product.notes, "", "");
  } catch (const Error& error) {
    list.fail(error.what());
  }
}

// The block of normal incidence; its rows have a specular part, a diffuse one, or both.
void add_angle_block(const JsonNode& data, Product& product) {
  const JsonNode blocks = data.at("angle_blocks");
  std::optional<JsonNode> list;
  for (const JsonNode& block : blocks.items())
    if (const auto angle = block.find("incidence_angle"); !list && (!angle || number_of(*angle) == 0))
      list = block.at("wavelength_data");
  if (!list) blocks.fail("has none with an \"incidence_angle\" of 0");
  std::vector<ScatteringRow> rows;
  bool scatters = false;
  for (const JsonNode& row : list->items()) {
    ScatteringRow& added = rows.emplace_back(ScatteringRow{.nm = number_of(row.at("w")) * 1000});
    const auto specular = row.find("specular"), diffuse = row.find("diffuse");
    if (!specular && !diffuse) row.fail("needs \"specular\", \"diffuse\" or both");
    const auto values = [](const JsonNode& part, double& tb) {
      tb = number_of(part.at("tb"));
      return PaneValues{number_of(part.at("tf")), number_of(part.at("rf")), number_of(part.at("rb"))};
    };
    if (specular) added.direct = values(*specular, added.direct_tb);
    if (diffuse) added.scattered = values(*diffuse, added.scattered_tb);
    scatters = scatters || added.scattered != PaneValues{};
  }
  if (rows.empty()) list->fail("has no rows");
  try {
    if (scatters) return take_scattering(product, rows, "");
    OpticalRows direct;
    for (const ScatteringRow& row : rows) direct.push_back({row.nm, row.direct});
    product.rows = checked_rows(std::move(direct), product.notes, "", "");
  } catch (const Error& error) {
    list->fail(error.what());
  }
}

Product product_of(const JsonNode& json) {
  Product product;
  product.name = json.text_or("name", json.text_or("product_name", ""));
  if (!is_glazing(json))
    json.fail(fmt::format("is of the type \"{}\"{}: only glazing is read", json.text_or("type", ""),
                          json.find("subtype") ? fmt::format(" (\"{}\")", json.text_or("subtype", "")) : ""));
  product.manufacturer = json.text_or("manufacturer_name", json.text_or("manufacturer", ""));
  product.kind = kind_of(json);
  const auto physical = json.find("physical_properties");
  if (const auto measured = physical ? physical : json.find("measured_data")) {
    if (const auto thickness = measured->find("thickness")) product.thickness_mm = number_of(*thickness);
    if (product.thickness_mm < 0) measured->fail("a thickness is negative");
    product.heat = heat_of(*measured);
    const auto specular = measured->find("is_specular");
    if (!physical && specular && !specular->boolean())
      json.fail("scatters light, and this version of the IGSDB does not have how much: version 2 has");
  }
  if (physical)
    add_angle_block(physical->at("optical_properties").at("optical_data"), product);
  else
    add_rows(row_list(json), product);
  add_emissivities(product.heat, product.rows);
  return product;
}

}  // namespace

bool is_igsdb(const JsonNode& root) {
  if (root.is_array()) {
    const auto items = root.items();
    return !items.empty() && !items[0].is_array() && is_igsdb(items[0]);
  }
  return root.is_object() && (root.find("spectral_data") || root.find("physical_properties"));
}

std::vector<Product> igsdb_products(const JsonNode& root) {
  if (!root.is_array()) return {product_of(root)};
  std::vector<Product> products;
  for (const JsonNode& item : root.items()) try {
      products.push_back(product_of(item));
    } catch (const Error& error) {
      if (is_glazing(item)) throw;
      products.push_back({.name = item.text_or("name", item.text_or("product_name", "")), .refused = error});
    }
  return products;
}

}  // namespace vitrail
