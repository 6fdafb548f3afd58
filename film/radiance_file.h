// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "film/develop.h"

namespace vitrail {

// Writes the colours, linear, as Radiance's .hdr: 8 bits a component and 8 of their common exponent, rows
// run-length encoded (Ward, "Real Pixels", Graphics Gems II, 1991). Components are cut off, as in Radiance's
// own programs, which read the middle of what is left. Values below 0 and NaN become 0. The file appears
// whole or not at all. Throws MachineError.
void write_radiance(const std::filesystem::path& file, const Picture& picture);

}  // namespace vitrail
