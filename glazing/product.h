// SPDX-License-Identifier: Apache-2.0
// A glazing product is what a manufacturer's or a laboratory's file says of one pane.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "glazing/optical_rows.h"
#include "glazing/pane_heat.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

// A kind says how a pane's values depend on the angle (glazing/pane.h).
enum class PaneKind {
  clear,   // one homogeneous sheet without coatings
  coated,  // anything else that was measured: coatings, laminates, films
};

// A product has `rows`, or `index` where its optical constants were measured, or `states`.
// Frits, etched and opal glass scatter: `scattered` is the part of `rows` that leaves in all
// directions, of the same wavelengths.
struct Product {
  std::string name, manufacturer{};
  PaneKind kind = PaneKind::clear;
  double thickness_mm = 0;  // 0 where the file does not say
  OpticalRows rows{};
  OpticalRows scattered{};  // empty where nothing is
  IndexRows index{};
  // A thermochromic group has rows by temperature in °C, ascending. `kind` is coated if any is.
  struct State {
    double temperature_c = 0;
    OpticalRows rows;
  };
  std::vector<State> states{};
  PaneHeat heat{};
  std::vector<std::string> notes{};  // what was repaired or approximated, in words
  std::optional<Error> refused{};    // of one among others: why it cannot be read; it has a name alone
};

// Reads every product of a file, told by its content: IGSDB or CGDB JSON, Optics text (.dat, .oag, .txt),
// EnergyPlus IDF or epJSON, or a table whose header names its columns (docs/why/glazing.md). Wavelengths are
// in nm afterwards. Throws Error with the file and the line, or the place in the JSON. EnergyPlus files throw
// only where no pane can be read, and else keep those that cannot as `refused`.
std::vector<Product> read_products(const std::filesystem::path& file);

// Returns the product of that name (case does not matter), or the only one where the name is empty. Throws
// Error, also what it is refused for.
Product read_product(const std::filesystem::path& file, const std::string& name = {});

// Reads "FILE" or "FILE#NAME", as users type it. A file of that whole name comes first.
Product read_named_product(const std::string& text);

}  // namespace vitrail
