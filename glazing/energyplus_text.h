// SPDX-License-Identifier: Apache-2.0
// This function writes a glazing as input of EnergyPlus.
#pragma once

#include <string>

#include "glazing/system.h"

namespace vitrail {

// Returns an IDF with spectral data of each pane (300 to 2500 nm), its gases, and a construction for each
// state. Energy management programs can switch between these. Panes and constructions are named after the
// system. Throws Error where check_heat does.
std::string energyplus_text(const GlazingSystem& system);

}  // namespace vitrail
