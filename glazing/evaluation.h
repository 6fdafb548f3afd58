// SPDX-License-Identifier: Apache-2.0
// The numbers of a data sheet: weighted averages of a system, and its colour.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "glazing/color_values.h"
#include "glazing/standard.h"
#include "glazing/system.h"

namespace vitrail {

// Which wavelengths a spectrum is taken at before it is weighted.
enum class Sampling {
  full,       // all that the panes have; then as WinCalc's "full" (docs/why/glazing.md says where it differs)
  condensed,  // WinCalc's 17 for sun, light and colour
  standard,   // each method's own, as Optics and the IGSDB
};

// A spectrum at the wavelengths asked for: of one angle, or of the hemisphere.
using SpectrumOf = std::function<SystemSpectrum(std::vector<double> nm)>;

// The figures of a glazing, as data sheets have them.
struct Evaluation {
  std::map<std::string, PaneValues> averages;  // by the method's name in lower case: "solar", "photopic" …
  bool has_color = false;
  ColorValues t, rf, rb;  // where the standard has all three COLOR_TRISTIM methods
};

// `wavelengths` are those of the panes.
Evaluation evaluate(const SpectrumOf& spectrum, const std::vector<double>& wavelengths,
                    const Standard& standard, Sampling sampling);

// Linear in the wavelength, held beyond the ends.
PaneValues value_at(const SystemSpectrum& spectrum, double nm);

// The average of one method over values linear in between; of the method's own wavelengths unless it has
// none.
PaneValues average(const SystemSpectrum& spectrum, const Method& method);

}  // namespace vitrail
