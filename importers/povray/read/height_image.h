// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/povray/read/token.h"
#include "importers/solids/grids.h"

namespace vitrail::pov {

class Reader;

// Reads heights of an image, from 0 to 1: from its grey if it has 16 bits, else from its red.
void read_heights(const std::string& file, solids::HeightField& field, Reader& reader, const Place& place);

}  // namespace vitrail::pov
