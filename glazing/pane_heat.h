// SPDX-License-Identifier: Apache-2.0
// This file has what panes and gaps are to heat.
#pragma once

#include <optional>

#include "glazing/optical_rows.h"

namespace vitrail {

struct GlazingSystem;

// Emissivities are hemispherical, at room temperature, of the product's own front and back.
struct PaneHeat {
  double conductivity_w_mk = 1;  // of glass, where the file does not say
  std::optional<double> emissivity_front{}, emissivity_back{};
  double infrared_t = 0;
  bool operator==(const PaneHeat&) const = default;
};

inline constexpr double stefan_boltzmann = 5.670374419e-8;  // W/(m²K⁴)
inline constexpr double freezing_k = 273.15;                // 0 °C

// This is that of soda-lime glass without a coating.
inline constexpr double glass_emissivity = 0.84;

// Adds emissivities 1 − T − R from rows of 5 to 25 µm at least, weighted by a black body of 300 K. NFRC 301's
// polynomials take them to the hemisphere: that of glass above 0.8, that of coatings elsewhere. Emissivities
// that are known stay; nothing is added where rows end before.
void add_emissivities(PaneHeat& heat, const OpticalRows& rows);

// Throws Error where heat cannot be computed: for a pane without a thickness or an emissivity, for two panes
// without a gap, or for values that no window has.
void check_heat(const GlazingSystem& system);

}  // namespace vitrail
