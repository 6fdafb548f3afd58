// SPDX-License-Identifier: Apache-2.0
// The colours of TM-30 are read here: color_fidelity_tables.txt has the numbers. Glazing alone uses them.
#pragma once

#include <array>

namespace vitrail {

// Returns the reflectances of the 99 colour evaluation samples (CIE 224:2017, ANSI/IES TM-30-20) each 5 nm
// from 380 to 780 nm. The first call reads them.
const std::array<std::array<float, 99>, 81>& cie_224_samples_5nm();

}  // namespace vitrail
