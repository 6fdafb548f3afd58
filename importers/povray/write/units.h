// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/povray/write/context.h"

namespace vitrail::povray {

// Returns the units of the file for a scene of this extent.
Units units_of(const Scene& scene);

}  // namespace vitrail::povray
