// SPDX-License-Identifier: Apache-2.0
// Heat balances are those of the centre of a vertical glazing, after ISO 15099:2003.
#pragma once

#include <array>
#include <vector>

#include "glazing/system.h"

namespace vitrail {

// Air and radiation on both sides have the same temperature; the surroundings are black. The room's film is
// that of still air (ISO 15099, 8.3.2.2).
struct HeatEnvironment {
  double outside_k = 0, inside_k = 0;
  double outside_w_m2k = 0;    // of convection alone
  double irradiance_w_m2 = 0;  // of the sun
};

// NFRC 100-2010 has −18 °C and 21 °C, wind of 5.5 m/s, no sun; 32 °C and 24 °C, 2.75 m/s, 783 W/m².
inline constexpr HeatEnvironment nfrc_winter{255.15, 294.15, 26, 0};
inline constexpr HeatEnvironment nfrc_summer{305.15, 297.15, 15, 783};

// These are the steady temperatures, and the heat that flows with them.
struct HeatBalance {
  std::vector<std::array<double, 2>> kelvin;  // of each pane, outer and inner surface
  double into_room_w_m2 = 0;                  // without the sun that comes through
};

// Returns steady temperatures of all surfaces. At each, what comes of the sun (half
// of the pane's share), the gap's gas (glazing/gap_convection.h), radiation and
// conduction of the pane sum to 0 (ISO 15099:2003, 5.3). `absorbed_w_m2` is the sun
// in each pane. Throws Error where check_heat does, or where no balance is found.
HeatBalance heat_balance(const GlazingSystem& system, const HeatEnvironment& environment,
                         const std::vector<double>& absorbed_w_m2, double height_m = 1);

// Returns U = flow ÷ difference of temperatures, W/(m²K), without sun.
double u_value(const GlazingSystem& system, const HeatEnvironment& environment);

// Returns the part of the sun that becomes heat in the room. It is what comes through, `transmittance`, and
// the flow that the absorbed part, `absorptance` of each pane, adds to it.
double solar_heat_gain(const GlazingSystem& system, const HeatEnvironment& environment, double transmittance,
                       const std::vector<double>& absorptance);

}  // namespace vitrail
