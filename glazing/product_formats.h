// SPDX-License-Identifier: Apache-2.0
// Each format has one reader, which takes the text and the name of its file. For glazing alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "glazing/product.h"

namespace vitrail {

class JsonNode;

// Reads IGSDB and CGDB: an object, or a list of them, with "spectral_data" (µm) and "measured_data" (mm).
// Version 2 has "physical_properties" instead of both, whose rows have a "specular" and a "diffuse" part.
std::vector<Product> igsdb_products(const JsonNode& root);
bool is_igsdb(const JsonNode& root);

// Reads Optics: "{ key } value" lines, then wavelength, T, Rf, Rb, in µm or nm as the header says. Glass that
// scatters has eight: Tf, Tb, Rf, Rb, each direct, then scattered.
std::vector<Product> optics_products(const std::string& text, const std::string& file);
bool is_optics(std::string_view text);

// Reads a header that names the columns (wavelength_nm or wavelength_um; T Rf Rb, T R, or n k), then rows.
std::vector<Product> table_products(const std::string& text, const std::string& file);

// They read EnergyPlus: WindowMaterial:Glazing, MaterialProperty:GlazingSpectralData and
// WindowMaterial:GlazingGroup:Thermochromic.
std::vector<Product> idf_products(const std::string& text, const std::string& file);
std::vector<Product> epjson_products(const JsonNode& root, const std::string& file);
bool is_idf(std::string_view text);

// Makes rows of a file those of a product: checks that there are wavelengths, that they are positive and that
// the values may be fractions. `where` begins the message.
OpticalRows checked_rows(OpticalRows rows, std::vector<std::string>& notes, const std::string& file,
                         const std::string& where);

// A ScatteringRow is one wavelength: direct light goes straight on or is mirrored, the rest is scattered.
struct ScatteringRow {
  double nm = 0;
  PaneValues direct, scattered;
  double direct_tb = 0, scattered_tb = 0;  // through it from the back
};

// Gives the product the sums of these rows, checked as above, and their scattered part.
void take_scattering(Product& product, const std::vector<ScatteringRow>& rows, const std::string& file);

}  // namespace vitrail
