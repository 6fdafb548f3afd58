// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "glazing/json_node.h"
#include "glazing/product_formats.h"
#include "glazing/text_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

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
  const auto fraction = [&](const char* key) -> std::optional<double> {
    const auto value = measured.find(key);
    if (!value) return {};
    if (!(value->number() >= 0 && value->number() <= 1)) value->fail("has to be in [0, 1]");
    return value->number();
  };
  heat.emissivity_front = fraction("emissivity_front");
  heat.emissivity_back = fraction("emissivity_back");
  heat.infrared_t = fraction("tir_front").value_or(0);
  // 0 stands where it was not measured.
  if (const double known = measured.number_or("conductivity", 0); known > 0) heat.conductivity_w_mk = known;
  return heat;
}

Product product_of(const JsonNode& json) {
  Product product;
  product.name = json.text_or("name", json.text_or("product_name", ""));
  if (!is_glazing(json))
    json.fail(fmt::format("is of the type \"{}\"{}: only glazing is read", json.text_or("type", ""),
                          json.find("subtype") ? fmt::format(" (\"{}\")", json.text_or("subtype", "")) : ""));
  product.manufacturer = json.text_or("manufacturer_name", json.text_or("manufacturer", ""));
  product.kind = kind_of(json);
  if (const auto measured = json.find("measured_data")) {
    product.thickness_mm = measured->number_or("thickness", 0);
    if (product.thickness_mm < 0) measured->fail("a thickness is negative");
    product.heat = heat_of(*measured);
    if (const auto specular = measured->find("is_specular"); specular && !specular->boolean())
      json.fail("scatters light; only specular glazing is read");
  }
  OpticalRows rows;
  const JsonNode list = row_list(json);
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
  add_emissivities(product.heat, product.rows);
  return product;
}

}  // namespace

bool is_igsdb(const JsonNode& root) {
  if (root.is_array()) {
    const auto items = root.items();
    return !items.empty() && items[0].is_object() && items[0].find("spectral_data").has_value();
  }
  return root.is_object() && root.find("spectral_data").has_value();
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
