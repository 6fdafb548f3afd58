// SPDX-License-Identifier: Apache-2.0
#include "glazing/standard_tables.h"

#include "glazing/standard_tables_text.h"
#include "scene/system/number_tables.h"

namespace vitrail {

namespace {

const std::vector<NumberTable<double>>& tables() {
  static const auto read = number_tables<double>(standard_tables_text, "glazing/standard_tables.txt");
  return read;
}

WeightTable weights(std::string_view name) {
  const NumberTable<double>& table = find_table(tables(), name, 2);
  WeightTable pairs;
  for (std::size_t i = 0; i < table.values.size(); i += 2)
    pairs.emplace_back(table.values[i], table.values[i + 1]);
  return pairs;
}

template <std::size_t rows, std::size_t columns>
std::array<std::array<double, columns>, rows> rows_of(std::string_view name) {
  std::array<std::array<double, columns>, rows> array;
  fill_from(tables(), name, columns, array);
  return array;
}

}  // namespace

WeightTable astm_e891() { return weights("astm-e891"); }
WeightTable en_410_solar() { return weights("en-410"); }
WeightTable iso_9050_1990_solar() { return weights("iso-9050-1990"); }
WeightTable iso_9050_1990_ultraviolet() { return weights("iso-9050-1990-uv"); }
WeightTable iso_9845_global() { return weights("iso-9845"); }

std::span<const double> cie_d65_5nm() {
  static const std::span<const double> d65 = find_table(tables(), "d65", 1).values;
  return d65;
}

std::span<const std::array<double, 3>> cie_1964_5nm() {
  static const auto observer = rows_of<95, 3>("cie-1964");
  return observer;
}

std::span<const std::array<double, 3>> cie_daylight_5nm() {
  static const auto components = rows_of<81, 3>("cie-daylight");
  return components;
}

std::span<const std::array<double, 8>> cie_test_colors_5nm() {
  static const auto colors = rows_of<81, 8>("cie-13.3");
  return colors;
}

}  // namespace vitrail
