// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_textures.h"

namespace vitrail::mitsuba_writer {

// Adds the radiance of a lamp that an image gives, inside of its emitter. Mitsuba's rgb variants leave out
// the scale of a d65 texture, and its spectral ones cut the colours of a bitmap at 1. So the scale goes into
// the image where nothing of it is above 1, or where it is grey; else, of a flat lamp, into a grid of one
// layer, which all variants take as it is. The rest is reported with its size.
void add_lamp_image(Context& context, Element emitter, const AreaLight& light, const Shape& shape);

}  // namespace vitrail::mitsuba_writer
