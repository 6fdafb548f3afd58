// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write_textures.h"

namespace vitrail::mitsuba_writer {

// One element with an id for each material, in order; others refer to it.
void write_materials(Context& context, Element root);

// Whether a surface looks different from its two sides, for each material of the context's scene.
std::vector<bool> with_sides(const Context& context);

// The element of the model alone.
void write_model(Context& context, Element parent, const Material& material, const std::string& id);

}  // namespace vitrail::mitsuba_writer
