// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_textures.h"

namespace vitrail::mitsuba_writer {

void write_lights(Context& context, Element root);

// Writes the emission of a shape, inside of its element.
void write_area_light(Context& context, Element element, const AreaLight& light, const Shape& shape);

}  // namespace vitrail::mitsuba_writer
