// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "glazing/energyplus.h"
#include "glazing/json_node.h"
#include "glazing/product_formats.h"
#include "glazing/text_file.h"

namespace vitrail {

namespace {

// The shortest text that is the number again.
std::string scalar(const JsonNode& node) {
  return node.is_text() ? node.text() : fmt::format("{}", node.number());
}

// The groups of an object, whatever its version calls the list, with these members.
void take_groups(const JsonNode& json, std::initializer_list<const char*> names, EnergyPlusObject& object) {
  for (const auto& [key, list] : json.members()) {
    if (!list.is_array()) continue;
    for (const JsonNode& group : list.items()) {
      auto& row = object.rows.emplace_back();
      for (const char* name : names) row.push_back(scalar(group.at(name)));
    }
  }
}

EnergyPlusObject object_of(const std::string& type, const std::string& name, const JsonNode& json) {
  EnergyPlusObject object{.type = type, .name = name};
  try {
    if (type == glazing_type) {
      for (const char* field : glazing_fields)
        if (const auto value = json.find(field)) object.fields[field] = scalar(*value);
    } else if (type == spectral_data_type) {
      take_groups(json, {"wavelength", "transmittance", "front_reflectance", "back_reflectance"}, object);
    } else {
      take_groups(json, {"optical_data_temperature", "window_material_glazing_name"}, object);
    }
  } catch (const Error& error) {
    object.refused = error;
  }
  return object;
}

}  // namespace

std::vector<Product> epjson_products(const JsonNode& root, const std::string& file) {
  std::vector<EnergyPlusObject> objects;
  for (const auto& [type, of_type] : root.members()) {
    const std::string known = lower(type);
    if (known != glazing_type && known != spectral_data_type && known != thermochromic_type) continue;
    for (const auto& [name, json] : of_type.members()) objects.push_back(object_of(known, name, json));
  }
  if (objects.empty())
    root.fail(
        "is neither a product of the IGSDB (\"spectral_data\") nor EnergyPlus (\"WindowMaterial:Glazing\")");
  return energyplus_products(objects, file);
}

}  // namespace vitrail
