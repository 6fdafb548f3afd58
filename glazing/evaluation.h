// SPDX-License-Identifier: Apache-2.0
// An evaluation makes the numbers of a data sheet: weighted averages of a system, and its colour.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "glazing/color_values.h"
#include "glazing/standard.h"
#include "glazing/system.h"

namespace vitrail {

// Sampling is the choice of wavelengths that a spectrum is taken at before it is weighted.
enum class Sampling {
  full,       // all that the panes have; then as WinCalc's "full" (docs/why/glazing.md says where it differs)
  condensed,  // WinCalc's 17 for sun, light and colour
  standard,   // each method's own, as Optics and the IGSDB
};

// It returns a spectrum at the wavelengths asked for: of one angle, or of the hemisphere.
using SpectrumOf = std::function<SystemSpectrum(std::vector<double> nm)>;

// An Evaluation has the figures of a glazing, as data sheets have them.
struct Evaluation {
  std::map<std::string, PaneValues> averages;  // by the method's name in lower case: "solar", "photopic" …
  bool has_color = false;
  ColorValues t, rf, rb;  // where the standard has all three COLOR_TRISTIM methods
};

// `wavelengths` are those of the panes.
Evaluation evaluate(const SpectrumOf& spectrum, const std::vector<double>& wavelengths,
                    const Standard& standard, Sampling sampling);

// Returns the value at a wavelength, linear in the wavelength, held beyond the ends.
PaneValues value_at(const SystemSpectrum& spectrum, double nm);

// Returns the average of one method over values linear in between, at the method's own
// wavelengths unless it has none.
PaneValues average(const SystemSpectrum& spectrum, const Method& method);

}  // namespace vitrail
