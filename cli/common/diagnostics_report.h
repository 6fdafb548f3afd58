// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/system/diagnostics.h"

namespace vitrail {

// Returns what an import could not keep, for a terminal. All of it is there, equal notes once with how many
// more there are (grouped_notes.h). It is empty when there is nothing to say.
std::string summarise(const Diagnostics& diagnostics);

// Does --strict: throws Error at the first thing that was not imported exactly.
void require_exact(const Diagnostics& diagnostics);

}  // namespace vitrail
