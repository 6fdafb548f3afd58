// SPDX-License-Identifier: Apache-2.0
#include "glazing/band_spectrum.h"

#include <fmt/format.h>

#include <algorithm>

#include "glazing/evaluation.h"

namespace vitrail {

namespace {

// The visible ends between two wavelengths of the solar weights.
OpticalRows two_levels(const PaneValues& visible, const PaneValues& outside) {
  return {{300, outside}, {379, outside}, {380, visible}, {780, visible}, {781, outside}, {2500, outside}};
}

double sun_in_visible() {
  SystemSpectrum spectrum;
  for (const OpticalRow& row : two_levels({1, 1, 1}, {0, 0, 0})) {
    spectrum.nm.push_back(row.nm);
    spectrum.values.push_back(row.at);
  }
  return average(spectrum, *find_method(nfrc_2003(), "SOLAR")).t;
}

}  // namespace

OpticalRows band_spectrum(const BandAverages& bands, std::vector<std::string>& notes) {
  const double f = sun_in_visible();
  const auto outside = [&](double solar, double visible, double most, const char* what) {
    const double wanted = (solar - f * visible) / (1 - f), taken = std::clamp(wanted, 0.0, most);
    if (std::abs(taken - wanted) > 1e-9)
      notes.push_back(fmt::format("no spectrum of two levels has the solar {} {}; it is {:.3f}", what, solar,
                                  f * visible + (1 - f) * taken));
    return taken;
  };
  PaneValues beyond;
  beyond.t = outside(bands.solar.t, bands.visible.t, 1, "transmittance");
  beyond.rf = outside(bands.solar.rf, bands.visible.rf, 1 - beyond.t, "reflectance");
  beyond.rb = outside(bands.solar.rb, bands.visible.rb, 1 - beyond.t, "back reflectance");
  return tidy(two_levels(bands.visible, beyond), notes);
}

}  // namespace vitrail
