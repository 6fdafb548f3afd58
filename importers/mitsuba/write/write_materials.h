// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_textures.h"

namespace vitrail::mitsuba_writer {

// Writes one element with an id for each material, in order; others refer to it.
void write_materials(Context& context, Element root);

// Writes the element of the model alone.
void write_model(Context& context, Element parent, const Material& material, const std::string& id);

}  // namespace vitrail::mitsuba_writer
