// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "glazing/system.h"

namespace vitrail {

// A ReadSystem has what was read. `notes` say, after the file's name, what was repaired or approximated.
struct ReadSystem {
  GlazingSystem system;
  std::vector<std::string> notes;
};

// Reads panes from outside. Each is "FILE" or "FILE#NAME" of a product (glazing/product.h), or a system file,
// whose layers take its place. One that switches may have "#state=0.6" or "#temperature=40" behind it, each
// at most once. A system file is JSON (docs/why/glazing.md):
//   {"name": "…", "layers": [{"pane": "low-e.json", "flipped": true}, {"gap_mm": 12.7},
//                            {"stack": [{"index": "glass.txt", "thickness_mm": 4},
//                                       {"index": "silver.txt", "thickness_nm": 12}, …]}]}
// with files beside it; a pane that switches has "states". Throws Error.
ReadSystem read_system(const std::vector<std::string>& files);

// Returns whether read_system may take a file: JSON with "layers" or "spectral_data",
// Optics, EnergyPlus, or "FILE#NAME".
bool is_glazing_file(const std::string& name);

}  // namespace vitrail
