// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/povray/write/context.h"

namespace vitrail::povray {

std::string camera_text(Context& context);

// Returns the options that the scene's own language cannot hold, for a file OUT.ini beside `pov_name`.
std::string options_text(Context& context, const std::string& pov_name);

}  // namespace vitrail::povray
