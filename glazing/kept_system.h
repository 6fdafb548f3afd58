// SPDX-License-Identifier: Apache-2.0
// A bundle keeps a system with all of its data as one text, which needs no other file.
#pragma once

#include <string>

#include "glazing/system.h"

namespace vitrail {

// Returns JSON. Of measured panes and of states it has what decides between 360 and 830 nm. So sheets_of the
// system that is read back is the same, bit for bit, in all of its states.
std::string kept_text(const GlazingSystem& system);

// Throws Error, in the name of `file`, where the text is not one of these.
GlazingSystem kept_system(const std::string& text, const std::string& file);

}  // namespace vitrail
