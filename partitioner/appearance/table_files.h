// SPDX-License-Identifier: Apache-2.0
// These files of tables say how a surface scatters (docs/why/scattering-tables.md).
#pragma once

#include <filesystem>

#include "scene/records/scattering_table.h"

namespace vitrail {

// Both throw Error with the file's name where it is not there, is of another format, or is damaged.
FourierTable read_fourier_table(const std::filesystem::path& file);
AdaptiveTable read_adaptive_table(const std::filesystem::path& file);

}  // namespace vitrail
