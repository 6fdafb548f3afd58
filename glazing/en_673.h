// SPDX-License-Identifier: Apache-2.0
// The European standards take a vertical glazing's heat and sun by a row of resistances, no temperatures.
#pragma once

#include <vector>

#include "glazing/system.h"

namespace vitrail {

// Resistances are in m²K/W: of each pane and of each gap between two.
struct Resistances {
  std::vector<double> panes, gaps;
};

// Returns the resistances of EN 673:2011: gaps at a mean of 283 K, radiation 4σT³/(1/ε₁ + 1/ε₂ − 1) (equation
// (5)) beside the gas. There are 15 K between the panes of one gap, shared among several by their resistances
// (clause 7). Panes are opaque to infrared. Throws Error where check_heat does.
Resistances en_673_resistances(const GlazingSystem& system);

// Returns U in W/(m²K), with h_e = 25, h_i = 3.6 + 4.1 ε/0.837 (EN 673:2011, clause 8).
double en_673_u_value(const GlazingSystem& system);

// Returns g = τ_e + q_i. Absorbed heat goes in and out in proportion to the resistances on either side. Here
// h_e = 23 and h_i = 3.6 + 4.4 ε/0.837 (EN 410:1998 and 2011, 5.4.6). The outer pane's heat starts at its
// outer surface, the inner pane's at its inner one, others' in their middle.
double en_410_solar_factor(const GlazingSystem& system, double transmittance,
                           const std::vector<double>& absorptance);

}  // namespace vitrail
