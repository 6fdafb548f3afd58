// SPDX-License-Identifier: Apache-2.0
#include "glazing/energyplus.h"

#include <fmt/format.h>

#include <algorithm>

#include "glazing/band_spectrum.h"
#include "glazing/product_formats.h"
#include "glazing/text_file.h"
#include "scene/diagnostics.h"

namespace vitrail {

namespace {

class Interpreter {
 public:
  Interpreter(const std::vector<EnergyPlusObject>& objects, const std::string& file)
      : objects_(objects), file_(file) {}

  std::vector<Product> products() const {
    std::vector<Product> result;
    for (const EnergyPlusObject& object : objects_) {
      if (object.type == glazing_type) result.push_back(pane(object));
      if (object.type == thermochromic_type) result.push_back(group(object));
    }
    return result;
  }

 private:
  [[noreturn]] void fail(const EnergyPlusObject& object, const std::string& message) const {
    throw Error(fmt::format("\"{}\" {}", object.name, message), {file_, object.line, 0});
  }

  double number(const EnergyPlusObject& object, std::string_view text) const {
    double value = 0;
    if (!parse_number(text, value)) fail(object, fmt::format("has \"{}\" where a number has to be", text));
    return value;
  }

  std::string field(const EnergyPlusObject& object, const std::string& name) const {
    const auto found = object.fields.find(name);
    return found == object.fields.end() ? "" : found->second;
  }

  double fraction(const EnergyPlusObject& object, const std::string& name) const {
    const std::string text = field(object, name);
    if (text.empty()) fail(object, fmt::format("needs {}", name));
    const double value = number(object, text);
    if (value < 0 || value > 1) fail(object, fmt::format("has {} {}, not in [0, 1]", name, text));
    return value;
  }

  const EnergyPlusObject& named(const EnergyPlusObject& from, const char* type,
                                const std::string& name) const {
    for (const EnergyPlusObject& object : objects_)
      if (object.type == type && same_word(object.name, name)) return object;
    fail(from, fmt::format("names \"{}\", and there is no {} of that name", name, type));
  }

  Product pane(const EnergyPlusObject& object) const {
    Product product;
    product.name = object.name;
    const double metres =
        number(object, field(object, "thickness").empty() ? "0" : field(object, "thickness"));
    if (metres < 0) fail(object, "has a negative thickness");
    product.thickness_mm = 1000 * metres;
    const std::string type = lower(field(object, "optical_data_type"));
    if (type == "spectral")
      product.rows = spectral(object, product.notes);
    else if (type == "spectralaverage")
      product.rows = averages(object, product);
    else
      fail(object, fmt::format("has the optical data type \"{}\"; Spectral and SpectralAverage are read",
                               field(object, "optical_data_type")));
    // EnergyPlus tells coated from clear glass by no field; unequal sides cannot be one clear sheet.
    const bool even = std::ranges::all_of(
        product.rows, [](const OpticalRow& row) { return std::abs(row.at.rf - row.at.rb) < 0.005; });
    product.kind = even ? PaneKind::clear : PaneKind::coated;
    return product;
  }

  OpticalRows spectral(const EnergyPlusObject& object, std::vector<std::string>& notes) const {
    const EnergyPlusObject& data =
        named(object, spectral_data_type, field(object, "window_glass_spectral_data_set_name"));
    OpticalRows rows;
    for (const auto& row : data.rows) {
      if (row.size() != 4) fail(data, "has a group without wavelength, T, Rf and Rb");
      rows.push_back(
          {1000 * number(data, row[0]), {number(data, row[1]), number(data, row[2]), number(data, row[3])}});
    }
    if (rows.empty()) fail(data, "has no wavelengths");
    return checked_rows(std::move(rows), notes, file_, fmt::format("\"{}\": ", data.name));
  }

  OpticalRows averages(const EnergyPlusObject& object, Product& product) const {
    const BandAverages bands{
        .solar = {fraction(object, "solar_transmittance_at_normal_incidence"),
                  fraction(object, "front_side_solar_reflectance_at_normal_incidence"),
                  fraction(object, "back_side_solar_reflectance_at_normal_incidence")},
        .visible = {fraction(object, "visible_transmittance_at_normal_incidence"),
                    fraction(object, "front_side_visible_reflectance_at_normal_incidence"),
                    fraction(object, "back_side_visible_reflectance_at_normal_incidence")}};
    product.notes.emplace_back("has averages, no spectrum: one was built that has these averages");
    return band_spectrum(bands, product.notes);
  }

  Product group(const EnergyPlusObject& object) const {
    Product product;
    product.name = object.name;
    for (const auto& row : object.rows) {
      if (row.size() != 2) fail(object, "has a group without a temperature and a glazing");
      Product of = pane(named(object, glazing_type, row[1]));
      product.states.push_back({number(object, row[0]), std::move(of.rows), of.kind});
      product.thickness_mm = of.thickness_mm;
    }
    if (product.states.empty()) fail(object, "has no glazing");
    std::ranges::stable_sort(product.states, {}, &Product::State::temperature_c);
    product.rows = product.states.front().rows;
    product.kind = product.states.front().kind;
    return product;
  }

  const std::vector<EnergyPlusObject>& objects_;
  const std::string& file_;
};

}  // namespace

std::vector<Product> energyplus_products(const std::vector<EnergyPlusObject>& objects,
                                         const std::string& file) {
  return Interpreter(objects, file).products();
}

}  // namespace vitrail
