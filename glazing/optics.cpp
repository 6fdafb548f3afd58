// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <optional>

#include "glazing/product_formats.h"
#include "glazing/text_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

struct Header {
  std::string key, value;
};

// "{ Thickness } 3.048" and "{ Type: Coated }".
Header header_of(std::string_view line) {
  const std::size_t end = line.find('}');
  const std::string_view inside = trimmed(line.substr(1, end - 1));
  const std::string_view behind = end == line.npos ? std::string_view() : trimmed(line.substr(end + 1));
  const std::size_t colon = inside.find(':');
  if (colon == inside.npos) return {lower(inside), std::string(behind)};
  return {lower(trimmed(inside.substr(0, colon))), std::string(trimmed(inside.substr(colon + 1)))};
}

class OpticsReader {
 public:
  OpticsReader(const std::string& text, const std::string& file) : lines_(text), file_(file) {}

  Product read() {
    for (std::string_view line; lines_.next(line);) {
      line = trimmed(line);
      if (line.empty() || line.front() == '!' || line.front() == '#') continue;
      if (line.front() == '{')
        take(header_of(line), line);
      else
        take_row(line);
    }
    if (to_nm_ == 0)
      throw Error("the header has no line \"{ Units, Wavelength Units } SI Microns\"", {file_});
    if (rows_.empty() && scattering_.empty())
      throw Error("there are no rows of wavelength, T, Rf, Rb", {file_});
    for (OpticalRow& row : rows_) row.nm *= to_nm_;
    for (ScatteringRow& row : scattering_) row.nm *= to_nm_;
    const bool clear = same_word(type_, "monolithic") && (side_.empty() || same_word(side_, "neither"));
    product_.kind = clear ? PaneKind::clear : PaneKind::coated;
    if (type_.empty()) product_.notes.emplace_back("does not say its type and counts as coated");
    if (scattering_.empty())
      product_.rows = checked_rows(std::move(rows_), product_.notes, file_, "");
    else
      take_scattering(product_, scattering_, file_);
    add_emissivities(product_.heat, product_.rows);
    return std::move(product_);
  }

 private:
  [[noreturn]] void fail(const std::string& message, std::string_view excerpt) const {
    throw Error(message, {file_, lines_.number(), 0}, std::string(excerpt.substr(0, 80)));
  }

  void take(const Header& header, std::string_view line) {
    const auto& [key, value] = header;
    if (key == "units, wavelength units") {
      const std::size_t last = value.find_last_of(" \t,");  // behind the system of units, as in "SI Microns"
      to_nm_ = nanometres_in(last == value.npos ? value : value.substr(last + 1));
      if (to_nm_ == 0) fail("the wavelengths' unit has to be Microns or Nanometers", line);
    } else if (key == "thickness") {
      std::string_view rest = value;
      if (!parse_number(next_word(rest), product_.thickness_mm) || product_.thickness_mm < 0)
        fail("the thickness has to be a number of millimetres", line);
    } else if (key == "conductivity") {
      std::string_view rest = value;
      if (double known = 0; parse_number(next_word(rest), known) && known > 0)
        product_.heat.conductivity_w_mk = known;
    } else if (key == "ir transmittance") {
      product_.heat.infrared_t = fractions(value, line).at(0).value_or(0);
    } else if (key == "emissivity, front back") {
      const auto known = fractions(value, line);
      product_.heat.emissivity_front = known[0];
      product_.heat.emissivity_back = known[1];
    } else if (key == "product name") {
      product_.name = value;
    } else if (key == "manufacturer") {
      product_.manufacturer = value;
    } else if (key == "type") {
      type_ = value;
    } else if (key == "coated side") {
      side_ = value;
    }
  }

  // The numbers of "Emis= 0.84 0.04"; none where there is nothing.
  std::array<std::optional<double>, 2> fractions(std::string_view text, std::string_view line) const {
    std::array<std::optional<double>, 2> values;
    std::string_view rest = text.substr(text.find('=') == text.npos ? 0 : text.find('=') + 1);
    for (auto& value : values) {
      const std::string_view word = next_word(rest);
      if (word.empty()) break;
      double number = 0;
      if (!parse_number(word, number) || number < 0 || number > 1) fail("expected numbers in [0, 1]", line);
      value = number;
    }
    return values;
  }

  // Of eight columns each is direct, then scattered.
  void take_row(std::string_view line) {
    constexpr const char* expected =
        "expected wavelength, T, Rf, Rb, or wavelength, Tf, Tb, Rf, Rb, each direct and then diffuse";
    std::vector<double> v;
    std::string_view rest = line;
    for (std::string_view word; !(word = next_word(rest)).empty();)
      if (!parse_number(word, v.emplace_back())) fail(expected, line);
    if (v.size() != 4 && v.size() != 9) fail(expected, line);
    if (v.size() == 4 ? !scattering_.empty() : !rows_.empty())
      fail("rows of three and of eight columns are in one file", line);
    if (v.size() == 4) {
      rows_.push_back({v[0], {v[1], v[2], v[3]}});
      return;
    }
    // Bounds of noise, as of the sums.
    for (std::size_t i = 1; i < v.size(); ++i)
      if (!(v[i] > -0.5 && v[i] < 2)) fail("the eight have to be fractions from 0 to 1", line);
    scattering_.push_back({v[0], {v[1], v[5], v[7]}, {v[2], v[6], v[8]}, v[3], v[4]});
  }

  Lines lines_;
  const std::string& file_;
  Product product_;
  OpticalRows rows_;
  std::vector<ScatteringRow> scattering_;
  std::string type_, side_;
  double to_nm_ = 0;
};

}  // namespace

bool is_optics(std::string_view text) {
  text = trimmed(text);
  return text.starts_with("{") && lower(text.substr(0, 40)).find("units") != text.npos;
}

std::vector<Product> optics_products(const std::string& text, const std::string& file) {
  return {OpticsReader(text, file).read()};
}

}  // namespace vitrail
