// SPDX-License-Identifier: Apache-2.0
// Optical rows are what a spectrophotometer measures of a pane at normal incidence.
#pragma once

#include <string>
#include <vector>

namespace vitrail {

// They are fractions of the light that falls on a pane: let through, reflected from its front and its back.
// The front looks outside unless the pane is turned round. Transmittance is the same from either side.
struct PaneValues {
  double t = 0, rf = 0, rb = 0;
  bool operator==(const PaneValues&) const = default;
};

struct OpticalRow {
  double nm = 0;
  PaneValues at;
};

// An IndexRow is the complex index of refraction n − ik, at one wavelength.
struct IndexRow {
  double nm = 0, n = 1, k = 0;
};

using OpticalRows = std::vector<OpticalRow>;  // ascending wavelengths, at least one
using IndexRows = std::vector<IndexRow>;      // likewise

// A range is from first to last, nm; without data in common first is above last.
struct WavelengthRange {
  double first_nm = 0, last_nm = 1e9;
};
WavelengthRange range_of(const OpticalRows& rows);
WavelengthRange common(WavelengthRange a, WavelengthRange b);

// They return values linear in the wavelength, held beyond the ends.
PaneValues value_at(const OpticalRows& rows, double nm);
IndexRow index_at(const IndexRows& rows, double nm);

// Sorts rows and makes those of one wavelength their mean. Brings noise of measurement into 0 ≤ T, R and T +
// R ≤ 1, where a reflectance gives way, as in Optics. What was done is appended to `notes` in words.
OpticalRows tidy(OpticalRows rows, std::vector<std::string>& notes);
IndexRows tidy(IndexRows rows, std::vector<std::string>& notes);

}  // namespace vitrail
