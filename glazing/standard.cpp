// SPDX-License-Identifier: Apache-2.0
#include "glazing/standard.h"

#include <algorithm>
#include <cmath>

#include "glazing/standard_tables.h"
#include "glazing/text_file.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

WeightTable every_5nm(double first_nm, std::size_t count, auto value) {
  WeightTable table;
  for (std::size_t i = 0; i < count; ++i) table.emplace_back(first_nm + 5 * static_cast<double>(i), value(i));
  return table;
}

// As ASTM E308 prints observers: 380 to 780 nm, four decimals. Held beyond, which a rounded 0 is not like.
WeightTable as_in_e308(auto at_360_and_on) {
  return every_5nm(380, 81, [&](std::size_t i) { return std::round(1e4 * at_360_and_on(i + 4)) / 1e4; });
}

WeightTable observer_1964(std::size_t component) {
  return as_in_e308([&](std::size_t i) { return cie_1964_5nm()[i][component]; });
}

Standard make_nfrc_2003() {
  const WeightTable sun = astm_e891();
  const WeightTable d65 =
      every_5nm(300, cie_d65_5nm().size(), [](std::size_t i) { return cie_d65_5nm()[i]; });
  const WeightTable y_1931 =
      as_in_e308([](std::size_t i) { return static_cast<double>(cie_1931()[5 * i][1]); });
  std::vector<double> suns, visible;
  for (const auto& [nm, value] : sun) suns.push_back(nm);
  for (int nm = 380; nm <= 780; nm += 5) visible.push_back(nm);
  const auto of_sun = [&](const char* name, double min_nm, double max_nm,
                          std::optional<DamageAction> action) {
    return Method{.name = name,
                  .source = sun,
                  .action = action,
                  .wavelengths_nm = suns,
                  .min_nm = min_nm,
                  .max_nm = max_nm};
  };
  const auto of_eye = [&](const char* name, WeightTable detector) {
    return Method{.name = name,
                  .source = d65,
                  .detector = std::move(detector),
                  .wavelengths_nm = visible,
                  .min_nm = 380,
                  .max_nm = 780};
  };
  return {.description = "NFRC 300-2003",
          .methods = {of_sun("SOLAR", 300, 2500, {}), of_eye("PHOTOPIC", y_1931),
                      of_eye("COLOR_TRISTIMX", observer_1964(0)), of_eye("COLOR_TRISTIMY", observer_1964(1)),
                      of_eye("COLOR_TRISTIMZ", observer_1964(2)), of_sun("TUV", 310, 380, {}),
                      // CIE 89/3, and the older one of Krochmann.
                      of_sun("TDW", 300, 700, DamageAction{3.6, 12}),
                      of_sun("TKR", 300, 500, DamageAction{12.28, 25.56})}};
}

}  // namespace

double weight_at(const WeightTable& table, double nm) {
  if (table.empty()) return 1;
  const auto above = std::upper_bound(table.begin(), table.end(), nm,
                                      [](double x, const auto& row) { return x < row.first; });
  if (above == table.begin()) return above->second;
  if (above == table.end()) return table.back().second;
  const auto& [nm_a, a] = *(above - 1);
  const auto& [nm_b, b] = *above;
  return a + (nm - nm_a) * (b - a) / (nm_b - nm_a);
}

const Method* find_method(const Standard& standard, const std::string& name) {
  for (const Method& method : standard.methods)
    if (same_word(method.name, name)) return &method;
  return nullptr;
}

const Standard& nfrc_2003() {
  static const Standard standard = make_nfrc_2003();
  return standard;
}

}  // namespace vitrail
