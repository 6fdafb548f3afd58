// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/povray/write/context.h"
#include "importers/povray/write/write_meshes.h"

namespace vitrail::povray {

// Returns a light source, a background or a sky sphere.
std::string light_text(Context& context, const Light& light);

// Returns the light of a rectangle of constant radiance; its mesh has to be shown besides, without a shadow.
std::string rectangle_light_text(Context& context, const Rectangle& rectangle, const AreaLight& light);

}  // namespace vitrail::povray
