// SPDX-License-Identifier: Apache-2.0
#include "glazing/pane_heat.h"

#include <fmt/format.h>

#include <cmath>

#include "glazing/system.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr double first_nm = 5000, last_nm = 25000;

// Planck's law at 300 K, in any unit.
double planck_at_300_k(double nm) {
  constexpr double second_constant_nm_k = 1.438777e7;
  return 1 / (std::pow(nm, 5) * std::expm1(second_constant_nm_k / (300 * nm)));
}

double hemispherical(double e) {
  return e > 0.8 ? e * (0.1569 + e * (3.7669 + e * (-5.4398 + e * 2.4733)))
                 : e * (1.3217 + e * (-1.8766 + e * (4.6586 + e * (-5.8349 + e * 2.7406))));
}

}  // namespace

void add_emissivities(PaneHeat& heat, const OpticalRows& rows) {
  if (rows.front().nm > first_nm || rows.back().nm < last_nm - 1) return;
  double power = 0, front = 0, back = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i - 1].nm < first_nm) continue;
    const double step = rows[i].nm - rows[i - 1].nm;
    for (const OpticalRow* row : {&rows[i - 1], &rows[i]}) {
      const double weight = step * planck_at_300_k(row->nm);
      power += weight;
      front += weight * (1 - row->at.t - row->at.rf);
      back += weight * (1 - row->at.t - row->at.rb);
    }
  }
  if (!heat.emissivity_front) heat.emissivity_front = hemispherical(front / power);
  if (!heat.emissivity_back) heat.emissivity_back = hemispherical(back / power);
}

void check_heat(const GlazingSystem& system) {
  for (std::size_t i = 0; i < system.layers.size(); ++i) {
    const GlazingLayer& layer = system.layers[i];
    const auto fail = [&](const char* what) {
      throw Error(fmt::format("pane {} (\"{}\") {}", i + 1, layer.name, what));
    };
    const auto beyond = [](double value, double least, double most) { return value < least || value > most; };
    if (!(layer.thickness_mm > 0)) fail("does not say its thickness");
    if (beyond(layer.thickness_mm, 1e-3, 1e4)) fail("is not between 0.001 mm and 10 m thick");
    if (beyond(layer.heat.conductivity_w_mk, 1e-4, 1e4))
      fail("has a conductivity beyond 0.0001 to 10 000 W/(m K)");
    if (!layer.heat.emissivity_front || !layer.heat.emissivity_back) fail("does not say its emissivity");
    for (const double e : {*layer.heat.emissivity_front, *layer.heat.emissivity_back})
      if (e <= 0 || e + layer.heat.infrared_t > 1)
        fail("has an emissivity of 0, or one that exceeds 1 with its infrared transmittance");
    if (i + 1 < system.layers.size() && !(layer.gap_behind_mm > 0)) fail("has no gap behind it");
    if (i + 1 < system.layers.size() && beyond(layer.gap_behind_mm, 1e-3, 1e4))
      fail("has a gap behind it that is not between 0.001 mm and 10 m wide");
  }
}

}  // namespace vitrail
