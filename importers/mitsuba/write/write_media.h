// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_textures.h"

namespace vitrail::mitsuba_writer {

// Writes one element with an id for each medium, in order, then those inside of subsurface materials.
void write_media(Context& context, Element root);

// Returns the medium inside of a subsurface material: "" where there is none.
std::string interior_of(const Context& context, Id<Material> material);

}  // namespace vitrail::mitsuba_writer
