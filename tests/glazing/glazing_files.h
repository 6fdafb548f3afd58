// SPDX-License-Identifier: Apache-2.0
// Small files of every format, all made up, of the same pane where the format can say it.
#pragma once

#include <fstream>
#include <string>

#include "tests/support/temporary_directory.h"

namespace vitrail::test {

inline const std::string igsdb_text = R"({"name": "Pane", "manufacturer_name": "Maker", "type": "glazing",
 "subtype": "monolithic", "coated_side": "Neither", "measured_data": {"is_specular": true, "thickness": 6.0},
 "spectral_data": {"spectral_data": [
  {"wavelength": 0.3, "T": 0.1, "Rf": 0.05, "Rb": 0.06},
  {"wavelength": 0.5, "T": 0.8, "Rf": 0.08, "Rb": 0.08},
  {"wavelength": 2.5, "T": 0.7, "Rf": 0.07, "Rb": 0.07}]}})";

inline const std::string optics_text = R"({ Units, Wavelength Units } SI Microns
{ Thickness } 6
{ }
{ Product Name: Pane }
{ Manufacturer: Maker }
{ Type: Monolithic }
{ Coated Side: Neither }
0.300 0.1 0.05 0.06
0.500 0.8 0.08 0.08
2.500 0.7 0.07 0.07
)";

inline const std::string table_text = R"(# made up
wavelength_nm, T, Rf, Rb
300, 0.1, 0.05, 0.06
500, 0.8, 0.08, 0.08
2500, 0.7, 0.07, 0.07
)";

inline const std::string index_text = R"(wavelength_um n k
0.3 1.55 1e-6
0.5 1.52 2e-7
2.5 1.48 4e-6
)";

inline const std::string idf_text = R"(! made up
WindowMaterial:Glazing,
  Pane,                    !- Name
  Spectral,                !- Optical Data Type
  Pane data,               !- Window Glass Spectral Data Set Name
  0.006, , , , , , , 0.0, 0.84, 0.84, 1.0;
MaterialProperty:GlazingSpectralData, PANE DATA, 0.3, 0.1, 0.05, 0.06,
  0.5, 0.8, 0.08, 0.08,  2.5, 0.7, 0.07, 0.07;
WindowMaterial:Glazing, Dark, SpectralAverage, , 0.006, 0.111, 0.179, 0.179, 0.128, 0.081, 0.081, 0, 0.84, 0.84, 1;
WindowMaterial:GlazingGroup:Thermochromic, Warm, 45, Dark, 25, Pane;
)";

inline const std::string epjson_text = R"({"WindowMaterial:Glazing": {
  "Pane": {"optical_data_type": "Spectral", "window_glass_spectral_data_set_name": "Pane data", "thickness": 0.006},
  "Dark": {"optical_data_type": "SpectralAverage", "thickness": 0.006,
    "solar_transmittance_at_normal_incidence": 0.111, "front_side_solar_reflectance_at_normal_incidence": 0.179,
    "back_side_solar_reflectance_at_normal_incidence": 0.179, "visible_transmittance_at_normal_incidence": 0.128,
    "front_side_visible_reflectance_at_normal_incidence": 0.081,
    "back_side_visible_reflectance_at_normal_incidence": 0.081}},
 "MaterialProperty:GlazingSpectralData": {"Pane data": {"extensions": [
  {"wavelength": 0.3, "transmittance": 0.1, "front_reflectance": 0.05, "back_reflectance": 0.06},
  {"wavelength": 0.5, "transmittance": 0.8, "front_reflectance": 0.08, "back_reflectance": 0.08},
  {"wavelength": 2.5, "transmittance": 0.7, "front_reflectance": 0.07, "back_reflectance": 0.07}]}},
 "WindowMaterial:GlazingGroup:Thermochromic": {"Warm": {"temperature_data": [
  {"optical_data_temperature": 45, "window_material_glazing_name": "Dark"},
  {"optical_data_temperature": 25, "window_material_glazing_name": "Pane"}]}}})";

inline std::filesystem::path write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

// Tf, Tb, Rf, Rb, each direct, then diffuse; the same at all wavelengths of light.
inline const std::string optics_frit = R"({ Units, Wavelength Units } SI Microns
{ Thickness } 6
{ Emissivity, front back } Emis= 0.86 0.84
{ Product Name: Frit }
{ Type: Coated }
{ Coated Side: Back }
0.300 0.10 0.50 0.10 0.48 0.02 0.18 0.03 0.22
0.800 0.10 0.50 0.10 0.48 0.02 0.18 0.03 0.22
2.500 0.20 0.40 0.20 0.38 0.02 0.13 0.03 0.16
)";

}  // namespace vitrail::test
