// SPDX-License-Identifier: Apache-2.0
// They are coefficients of heat in W/(m²K): of gas in a vertical gap, of air along a vertical pane.
#pragma once

#include "glazing/gas.h"

namespace vitrail {

// Returns the coefficient between two surfaces at these temperatures: ISO 15099:2003, 5.3.3, (48) to (52).
double iso_15099_gap(const GasMixture& gas, double width_m, double height_m, double kelvin_a,
                     double kelvin_b);

// Returns that of still room air at the inner surface: ISO 15099:2003, 8.3.2.2, at a tilt of 90°.
double iso_15099_room(double height_m, double kelvin_surface, double kelvin_air);

// Returns the gap's coefficient at a mean of 283 K: EN 673:2011, 5.3, Nu = max(1, 0.035 (Gr Pr)^0.38).
double en_673_gap(const GasMixture& gas, double width_m, double difference_k);

}  // namespace vitrail
