// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/system/diagnostics.h"

namespace vitrail {

// What an import could not keep, for a terminal: all of it, equal notes once with how many more there are
// (grouped_notes.h). Empty when there is nothing to say.
std::string summarise(const Diagnostics& diagnostics);

// --strict: throws Error at the first thing that was not imported exactly.
void require_exact(const Diagnostics& diagnostics);

}  // namespace vitrail
