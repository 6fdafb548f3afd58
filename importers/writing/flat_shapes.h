// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "importers/writing/conversion_notes.h"

namespace vitrail {

// It is a shape in the world, on its own or as a part of an instance.
struct FlatShape {
  const Shape& shape;
  Transform object_to_world;
  bool flip = false;  // the front is where the triangles, taken to the world, run clockwise
};

// Returns the shapes of a scene for formats without prototypes, in order, those of instances last. Throws
// Error where they are more than 2²⁶.
std::vector<FlatShape> flat_shapes(const Scene& scene);

// Notes what formats of bare geometry lose: the camera and the film (if the file gave them), lights, media,
// and that instances share their shapes.
void note_geometry_only(ConversionNotes& notes);

// Notes that quadrics are written as triangles, each shape once.
void note_quadrics(const std::vector<FlatShape>& shapes, ConversionNotes& notes);

}  // namespace vitrail
