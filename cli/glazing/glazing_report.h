// SPDX-License-Identifier: Apache-2.0
// This is what `vitrail glazing` prints: a table to read, JSON, and spectra as CSV.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "glazing/evaluation.h"

namespace vitrail {

// A result is of one angle of incidence, or of the hemisphere by a rule where there is none.
struct GlazingResult {
  std::optional<double> theta_deg;
  HemisphereRule rule = HemisphereRule::gauss;
  Evaluation values;
};

struct GlazingReport {
  GlazingSystem system;
  std::string standard, sampling;
  std::vector<std::string> notes;
  std::vector<GlazingResult> results;
};

std::string glazing_table(const GlazingReport& report);
std::string glazing_json(const GlazingReport& report);

// Returns "wavelength_nm,T,Rf,Rb" of one angle, a table that is read back as a product;
// of several, columns T_15 … of each.
std::string glazing_csv(const std::vector<double>& theta_deg, const std::vector<SystemSpectrum>& spectra);

}  // namespace vitrail
