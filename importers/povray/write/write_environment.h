// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/povray/write/context.h"

namespace vitrail::povray {

// Returns a sky sphere of the light's image.
std::string environment_text(Context& context, const EnvironmentLight& light, const Origin& origin);

}  // namespace vitrail::povray
