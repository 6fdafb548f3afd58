// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "glazing/product_formats.h"
#include "glazing/text_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr const char* expected_header =
    "a table of glazing begins with the names of its columns: wavelength_nm or wavelength_um, then T Rf Rb, "
    "T R, "
    "or n k";

class ProductReader {
 public:
  ProductReader(const std::string& text, const std::string& file) : lines_(text), file_(file) {}

  Product read() {
    read_header();
    for (std::string_view line; next_line(line);) read_row(line);
    if (optical_.empty() && index_.empty()) throw Error("there are no rows below the header", {file_});
    Product product;
    if (is_index_) {
      product.index = tidy(std::move(index_), product.notes);
    } else {
      product.rows = checked_rows(std::move(optical_), product.notes, file_, "");
      product.kind = PaneKind::coated;
    }
    return product;
  }

 private:
  [[noreturn]] void fail(const std::string& message, std::string_view excerpt) const {
    throw Error(message, {file_, lines_.number(), 0}, std::string(excerpt.substr(0, 80)));
  }

  // Without comments and empty lines.
  bool next_line(std::string_view& line) {
    while (lines_.next(line)) {
      line = trimmed(line.substr(0, line.find('#')));
      if (!line.empty()) return true;
    }
    return false;
  }

  void read_header() {
    std::string_view line;
    if (!next_line(line)) throw Error(expected_header, {file_});
    std::vector<std::string> names;
    std::string_view rest = line;
    for (std::string_view word; !(word = next_word(rest)).empty();) names.push_back(lower(word));
    const std::vector<std::string> columns(names.begin() + (names.empty() ? 0 : 1), names.end());
    const bool nm = !names.empty() && names[0] == "wavelength_nm";
    const bool um = !names.empty() && names[0] == "wavelength_um";
    is_index_ = columns == std::vector<std::string>{"n", "k"};
    one_sided_ = columns == std::vector<std::string>{"t", "r"};
    const bool optical = one_sided_ || columns == std::vector<std::string>{"t", "rf", "rb"};
    if ((!nm && !um) || (!is_index_ && !optical)) fail(expected_header, line);
    to_nm_ = nm ? 1 : 1000;
    width_ = names.size();
  }

  void read_row(std::string_view line) {
    std::vector<double> v;
    std::string_view rest = line;
    for (std::string_view word; !(word = next_word(rest)).empty();)
      if (!parse_number(word, v.emplace_back())) fail("expected a number", line);
    if (v.size() != width_) fail(fmt::format("expected {} numbers", width_), line);
    if (!(v[0] > 0)) fail("a wavelength has to be above 0", line);
    if (!is_index_) {
      optical_.push_back({v[0] * to_nm_, {v[1], v[2], one_sided_ ? v[2] : v[3]}});
      return;
    }
    if (!(v[1] > 0) || v[2] < 0) fail("an index has to have n above 0 and k not below 0", line);
    index_.push_back({v[0] * to_nm_, v[1], v[2]});
  }

  Lines lines_;
  const std::string& file_;
  OpticalRows optical_;
  IndexRows index_;
  bool is_index_ = false, one_sided_ = false;
  double to_nm_ = 1;
  std::size_t width_ = 0;
};

}  // namespace

std::vector<Product> table_products(const std::string& text, const std::string& file) {
  return {ProductReader(text, file).read()};
}

}  // namespace vitrail
