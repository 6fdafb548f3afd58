// SPDX-License-Identifier: Apache-2.0
#include "glazing/energyplus.h"

#include <fmt/format.h>

#include <algorithm>

#include "glazing/band_spectrum.h"
#include "glazing/product_formats.h"
#include "glazing/text_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

class Interpreter {
 public:
  Interpreter(const std::vector<EnergyPlusObject>& objects, const std::string& file)
      : objects_(objects), file_(file) {}

  std::vector<Product> products() const {
    std::vector<Product> result;
    for (const EnergyPlusObject& object : objects_) {
      if (object.type != glazing_type && object.type != thermochromic_type) continue;
      // A building has many panes: one that cannot be read is no reason to refuse the others.
      try {
        result.push_back(object.type == glazing_type ? pane(object) : group(object));
      } catch (const Error& error) {
        result.push_back({.name = object.name, .refused = error});
      }
    }
    return result;
  }

 private:
  [[noreturn]] void fail(const EnergyPlusObject& object, const std::string& message) const {
    throw Error(fmt::format("\"{}\" {}", object.name, message), {file_, object.line, 0});
  }

  static const EnergyPlusObject& readable(const EnergyPlusObject& object) {
    if (object.refused) throw *object.refused;
    return object;
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
      if (object.type == type && same_word(object.name, name)) return readable(object);
    fail(from, fmt::format("names \"{}\", and there is no {} of that name", name, type));
  }

  Product pane(const EnergyPlusObject& object) const {
    readable(object);
    Product product;
    product.name = object.name;
    const double metres =
        number(object, field(object, "thickness").empty() ? "0" : field(object, "thickness"));
    if (metres < 0) fail(object, "has a negative thickness");
    product.thickness_mm = 1000 * metres;
    product.heat = heat(object);
    const std::string type = lower(field(object, "optical_data_type"));
    if (type == "spectral")
      product.rows = spectral(object, product.notes);
    else if (type == "spectralaverage")
      product.rows = averages(object, product);
    else
      fail(object, fmt::format("has the optical data type \"{}\"; Spectral and SpectralAverage are read",
                               field(object, "optical_data_type")));
    apply_dirt(object, product);
    const std::string diffusing = field(object, "solar_diffusing");
    if (!diffusing.empty() && !same_word(diffusing, "no"))
      fail(object,
           fmt::format("scatters light (its Solar Diffusing is \"{}\"); only specular glazing is read",
                       diffusing));
    // EnergyPlus tells coated from clear glass by no field; unequal sides cannot be one clear sheet.
    const bool even = std::ranges::all_of(
        product.rows, [](const OpticalRow& row) { return std::abs(row.at.rf - row.at.rb) < 0.005; });
    product.kind = even ? PaneKind::clear : PaneKind::coated;
    return product;
  }

  // Empty fields have EnergyPlus' own defaults: opaque to infrared, 0.84 and 0.9 W/(m K).
  PaneHeat heat(const EnergyPlusObject& object) const {
    const auto value = [&](const char* name, double otherwise) {
      const std::string text = field(object, name);
      return text.empty() ? otherwise : number(object, text);
    };
    const PaneHeat heat{.conductivity_w_mk = value("conductivity", 0.9),
                        .emissivity_front = value("front_side_infrared_hemispherical_emissivity", 0.84),
                        .emissivity_back = value("back_side_infrared_hemispherical_emissivity", 0.84),
                        .infrared_t = value("infrared_transmittance_at_normal_incidence", 0)};
    if (!(heat.conductivity_w_mk > 0)) fail(object, "has a conductivity that is not above 0");
    for (const double share : {*heat.emissivity_front, *heat.emissivity_back, heat.infrared_t})
      if (!(share >= 0 && share <= 1))
        fail(object, "has an emissivity or infrared transmittance not in [0, 1]");
    return heat;
  }

  // EnergyPlus means it for the outermost pane of a window alone; a product does not know where it will
  // stand.
  void apply_dirt(const EnergyPlusObject& object, Product& product) const {
    const std::string text = field(object, "dirt_correction_factor_for_solar_and_visible_transmittance");
    const double clean = text.empty() ? 1 : number(object, text);
    if (!(clean > 0 && clean <= 1))
      fail(object, fmt::format("has the dirt correction factor {}, not in (0, 1]", text));
    if (clean == 1) return;
    for (OpticalRow& row : product.rows) row.at.t *= clean;
    product.notes.push_back(
        fmt::format("T is multiplied by its dirt correction factor {}, wherever the pane stands", text));
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
    readable(object);
    Product product;
    product.name = object.name;
    for (const auto& row : object.rows) {
      if (row.size() != 2) fail(object, "has a group without a temperature and a glazing");
      Product of = pane(named(object, glazing_type, row[1]));
      for (const std::string& note : of.notes)
        product.notes.push_back(fmt::format("\"{}\": {}", of.name, note));
      if (of.kind == PaneKind::coated) product.kind = PaneKind::coated;  // as states of a system file
      product.states.push_back({number(object, row[0]), std::move(of.rows)});
      product.thickness_mm = of.thickness_mm;
      product.heat = of.heat;
    }
    if (product.states.empty()) fail(object, "has no glazing");
    std::ranges::stable_sort(product.states, {}, &Product::State::temperature_c);
    product.rows = product.states.front().rows;
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
