// SPDX-License-Identifier: Apache-2.0
// This file has what IDF and epJSON share of EnergyPlus input, for use inside glazing alone.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "glazing/product.h"

namespace vitrail {

// An object has named fields as texts, and the rows of its repeated group. Field names are epJSON's.
struct EnergyPlusObject {
  std::string type, name;  // the type in lower case
  int line = 0;            // 0 in epJSON
  std::map<std::string, std::string> fields;
  std::vector<std::vector<std::string>> rows;
  std::optional<Error> refused{};  // why it is none, where its form is wrong
};

// Returns the glazing among the objects, also what cannot be read (Product::refused). References between
// objects are by name, whatever the case.
std::vector<Product> energyplus_products(const std::vector<EnergyPlusObject>& objects,
                                         const std::string& file);

inline constexpr const char* glazing_type = "windowmaterial:glazing";
inline constexpr const char* spectral_data_type = "materialproperty:glazingspectraldata";
inline constexpr const char* thermochromic_type = "windowmaterial:glazinggroup:thermochromic";

// They are WindowMaterial:Glazing's fields behind its name, in the order of an IDF. Those of heat keep their
// places; later ones are about strength, and the tables of SpectralAndAngle, which is refused.
inline constexpr std::array glazing_fields{
    "optical_data_type",
    "window_glass_spectral_data_set_name",
    "thickness",
    "solar_transmittance_at_normal_incidence",
    "front_side_solar_reflectance_at_normal_incidence",
    "back_side_solar_reflectance_at_normal_incidence",
    "visible_transmittance_at_normal_incidence",
    "front_side_visible_reflectance_at_normal_incidence",
    "back_side_visible_reflectance_at_normal_incidence",
    "infrared_transmittance_at_normal_incidence",
    "front_side_infrared_hemispherical_emissivity",
    "back_side_infrared_hemispherical_emissivity",
    "conductivity",
    "dirt_correction_factor_for_solar_and_visible_transmittance",
    "solar_diffusing",
};

}  // namespace vitrail
