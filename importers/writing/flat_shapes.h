// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "importers/writing/conversion_notes.h"

namespace vitrail {

// A shape in the world, on its own or as a part of an instance.
struct FlatShape {
  const Shape& shape;
  Transform object_to_world;
  bool flip = false;  // the front is where the triangles, taken to the world, run clockwise
};

// The shapes of a scene for formats without prototypes, in order, those of instances last. Throws Error where
// they are beyond all measure.
std::vector<FlatShape> flat_shapes(const Scene& scene);

// What formats of bare geometry lose: the camera (if the file gave one), lights, media, and that instances
// share their shapes.
void note_geometry_only(ConversionNotes& notes);

// That quadrics are written as triangles, each shape once.
void note_quadrics(const std::vector<FlatShape>& shapes, ConversionNotes& notes);

}  // namespace vitrail
