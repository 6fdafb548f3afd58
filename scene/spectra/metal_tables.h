// SPDX-License-Identifier: Apache-2.0
// The indices of refraction eta + i·k of metals are read here: metal_tables.txt has the numbers.
#pragma once

#include <vector>

#include "scene/system/number_tables.h"

namespace vitrail {

// Returns a table for each metal, in the order of their names: "Au"; a crystal axis or a second source is
// part of a name: "TiO2-e", "Cu_palik". The columns are the wavelength in nm, ascending, eta and k. The first
// call reads them.
const std::vector<NumberTable<float>>& metal_tables();

}  // namespace vitrail
