// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/povray/read/value.h"
#include "scene/geometry/transform.h"

namespace vitrail::pov {

class Reader;

// It holds what `transform {}` gives.
struct Placement {
  Transform transform;
};

// Turns about x, then y, then z.
Transform rotation(Vector3d degrees);

// Reads translate, rotate, scale, matrix or transform, if one comes, and puts it behind what was there.
bool read_transform(Reader& reader, Transform& transform);

// Reads behind the word `transform`: a block, or the name of one.
Transform read_transform_block(Reader& reader);

}  // namespace vitrail::pov
