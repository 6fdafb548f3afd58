// SPDX-License-Identifier: Apache-2.0
// A band spectrum stands for glass of which only averages are published.
#pragma once

#include <string>
#include <vector>

#include "glazing/optical_rows.h"

namespace vitrail {

struct BandAverages {
  PaneValues solar, visible;
};

// Returns values constant from 380 to 780 nm, and another constant outside, with these averages of NFRC
// 300-2003. Where no constant within [0, 1] makes the sun's, the nearest is taken and `notes` says so.
OpticalRows band_spectrum(const BandAverages& bands, std::vector<std::string>& notes);

}  // namespace vitrail
