// SPDX-License-Identifier: Apache-2.0
#include "glazing/sheet.h"

#include <algorithm>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

namespace {

// Those of the panes, and steps of 5 nm where these are farther apart: what panes do together is not linear
// in between, and the model of coated glass changes its curve where T is 0.645.
std::vector<double> visible_wavelengths(const GlazingSystem& system) {
  std::vector<double> nm;
  for (double x = lambda_min_nm; x < lambda_max_nm; x += 5) nm.push_back(x);
  nm.push_back(lambda_max_nm);
  for (const double x : common_wavelengths(system))
    if (x > lambda_min_nm && x < lambda_max_nm) nm.push_back(x);
  std::ranges::sort(nm);
  nm.erase(std::unique(nm.begin(), nm.end(), [](double a, double b) { return b - a < 1e-3; }), nm.end());
  return nm;
}

}  // namespace

GlazingSheets sheets_of(const GlazingSystem& system, Polarisation polarisation) {
  const std::vector<double> nm = visible_wavelengths(system);
  std::vector<double> cosines;
  constexpr int steps = 180;
  for (int i = 0; i <= steps; ++i) cosines.push_back(sin_pi(i / (2.0 * steps)));
  cosines.back() = 1;

  GlazingSheets sheets;
  for (MeasuredSheet* sheet : {&sheets.front, &sheets.back}) {
    for (const double x : nm) sheet->wavelengths_nm.push_back(static_cast<float>(x));
    for (const double c : cosines) sheet->cosines.push_back(static_cast<float>(c));
  }
  const bool scatters = scatters_light(system);
  for (const double x : nm) {
    const Streams normal = system_streams(system, x, 1, polarisation);
    const PaneValues& made = normal.scattered;
    if (scatters) {
      const auto add = [](ScatteredShares& side, double r, double t) {
        side.reflected.push_back(static_cast<float>(r)), side.transmitted.push_back(static_cast<float>(t));
      };
      add(sheets.front_scattered, made.rf, made.t);
      add(sheets.back_scattered, made.rb, made.t);
    }
    for (const double c : cosines) {
      const PaneValues v = system_streams(system, x, c, polarisation).direct;
      const auto add = [&](MeasuredSheet& sheet, double r, double scattered) {
        const double left = std::max(0.0, 1 - scattered), t = std::clamp(v.t, 0.0, left);
        sheet.transmittance.push_back(static_cast<float>(t));
        sheet.reflectance.push_back(static_cast<float>(std::clamp(r, 0.0, left - t)));
      };
      add(sheets.front, v.rf, made.rf + made.t);
      add(sheets.back, v.rb, made.rb + made.t);
    }
  }
  return sheets;
}

}  // namespace vitrail
