// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace vitrail {

// It holds the numbers of POV-Ray's noise (scene/models/pattern_noise.h): those of a corner of the lattice
// are twelve in a row, of which a place of 256 is the first.
extern const std::array<double, 267> pattern_noise_table;

}  // namespace vitrail
