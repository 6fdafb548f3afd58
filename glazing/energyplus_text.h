// SPDX-License-Identifier: Apache-2.0
// A glazing as input of EnergyPlus.
#pragma once

#include <string>

#include "glazing/system.h"

namespace vitrail {

// IDF with spectral data of each pane (300 to 2500 nm), its gases, and a construction for each state, which
// energy management programs can switch between. Panes and constructions are named after the system. Throws
// Error where check_heat does.
std::string energyplus_text(const GlazingSystem& system);

}  // namespace vitrail
