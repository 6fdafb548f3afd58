// SPDX-License-Identifier: Apache-2.0
// Writers ask these functions about quadrics.
#pragma once

#include <optional>
#include <string>

#include "scene/records/uv_uses.h"

namespace vitrail {

// It is a shape whose mesh is a quadric. Its front is outside, of a disk +z, unless the transform mirrors or
// `flip_orientation` holds, but not both.
struct QuadricShape {
  Quadric quadric;
  Transform to_world;
  bool flip_orientation = false;
};

// Returns the shape as a quadric of this convention of (u,v), of which another sphere is a mirror image.
// Returns nothing where its mesh is none, or where (u,v) show and the convention cannot say them.
std::optional<QuadricShape> placed_quadric(const Scene& scene, const Shape& shape, QuadricUv uv,
                                           ShapeUvUses& uvs);

// Returns whether the quadric has no holes and goes all the way round.
bool is_whole(const Quadric& quadric);

// They are the lengths of x, y and z under a transform, and whether they stay perpendicular, to 1e-6.
struct Axes {
  double x = 1, y = 1, z = 1;
  bool perpendicular = false;

  bool keep_circles() const;  // x and y are as long, and no shear: what turns about z stays that
  bool keep_spheres() const;
};
Axes axes_of(const Transform& transform);

// Returns a phrase for diagnostics: "a partial sphere becomes triangles, 256 for a full turn".
std::string as_triangles(const Quadric& quadric);

}  // namespace vitrail
