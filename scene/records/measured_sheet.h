// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace vitrail {

// It holds the fractions of light that a sheet reflects and lets straight through, by wavelength and by the
// cosine of the angle of incidence: [wavelength][cosine], bilinear in between, held beyond the ends
// (docs/why/measured-glass.md).
struct MeasuredSheet {
  std::vector<float> wavelengths_nm, cosines;     // ascending, at least one each
  std::vector<float> reflectance, transmittance;  // in [0, 1], as their sums
  bool operator==(const MeasuredSheet&) const = default;
};

}  // namespace vitrail
