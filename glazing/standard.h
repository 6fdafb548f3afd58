// SPDX-License-Identifier: Apache-2.0
// A standard has methods: what a spectrum is weighted by, and how the weights are summed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vitrail {

// A table has nm, ascending, and relative values; linear in between, held beyond the ends. Empty is 1.
using WeightTable = std::vector<std::pair<double, double>>;

double weight_at(const WeightTable& table, double nm);

// The action is exp(a − b·λ), λ in µm: damage by ultraviolet light (CIE 89/3, Krochmann 1978).
struct DamageAction {
  double a = 0, b = 0;
};

enum class IntegrationRule {
  trapezoidal,
  rectangular,   // the value at the lower end of each interval
  pre_weighted,  // the weights hold their intervals already
};

struct Method {
  std::string name;  // SOLAR, PHOTOPIC, TUV, TDW, TKR, COLOR_TRISTIMX …Y …Z
  WeightTable source, detector;
  std::optional<DamageAction> action;  // in the detector's place
  std::vector<double> wavelengths_nm;  // to be summed over; empty: those of the data
  IntegrationRule rule = IntegrationRule::trapezoidal;
  double min_nm = 0, max_nm = 1e9;  // both within
};

struct Standard {
  std::string description;
  std::vector<Method> methods;
};

// Returns nullptr where a standard has no such method.
const Method* find_method(const Standard& standard, const std::string& name);

// Returns NFRC 300-2003 as WINDOW has it: the sun of ASTM E891-87, D65, the CIE observers of 1931 (light) and
// 1964 (colour). Its numbers are in standard_tables.txt with their sources.
const Standard& nfrc_2003();

// They return sun (SOLAR), ultraviolet (TUV) and light (PHOTOPIC) of Europe's standards. EN 410 has table 2
// of 1998, air mass 1. ISO 9050 of 1990 has Moon's sun at air mass 2. ISO 9050 of 2003 has ISO 9845-1's
// global sun at air mass 1.5, by the trapezoidal rule at that table's own wavelengths.
const Standard& en_410();
const Standard& iso_9050_1990();
const Standard& iso_9050_2003();

// Reads a WINDOW standard (.std) with the files of weights that it names, beside it. Methods of thermal
// radiation are left out. Throws Error.
Standard read_standard(const std::filesystem::path& file);

}  // namespace vitrail
