// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

// It divides a range of wavelengths into equal intervals, in nm, in which a film keeps radiance beside its
// XYZ.
struct SpectralBins {
  int count = 0;  // 0: none
  double min_nm = 360, max_nm = 830;

  double width_nm() const { return (max_nm - min_nm) / count; }
  double centre_nm(int bin) const { return min_nm + (bin + 0.5) * width_nm(); }
  bool operator==(const SpectralBins&) const = default;
};

inline constexpr int max_spectral_bins = 1024;

}  // namespace vitrail
