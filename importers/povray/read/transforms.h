// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/povray/read/value.h"
#include "scene/geometry/transform.h"

namespace vitrail::pov {

class Reader;

// What `transform {}` gives.
struct Placement {
  Transform transform;
};

// About x, then y, then z.
Transform rotation(Vector3d degrees);

// translate, rotate, scale, matrix or transform, if that is what comes: read, and put behind what was there.
bool read_transform(Reader& reader, Transform& transform);

// Behind the word `transform`: a block, or the name of one.
Transform read_transform_block(Reader& reader);

}  // namespace vitrail::pov
