// SPDX-License-Identifier: Apache-2.0
// This file defines objects and their instances. An object has vertices of its own, rounded to float around
// its own centre; an instance places it. Only this file decides which triangles stand in the world. A scene
// whose instances are kept and the same scene flattened thus have the same triangles, to the last bit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/geometry/bounds.h"
#include "scene/geometry/transform.h"
#include "scene/geometry/vec.h"
#include "scene/shapes/quadric.h"

namespace vitrail {

// It is the most instances that may stand within each other: one more than of prototypes, for the quadrics in
// them.
inline constexpr int max_instance_depth = 9;

// An affine map is p' = m·(p, 1), m[row][column].
struct Affine {
  double m[3][4];
};

// Returns the map of a transform whose last row is 0 0 0 1.
Affine affine(const Transform& t);
bool is_affine(const Transform& t);

// Returns a∘b. The matrix of a chain of instances is ((m₁∘m₂)∘m₃)∘…
Affine compose(const Affine& a, const Affine& b);

// Returns the place of a quadric within `outer`. It composes matrices; a packed curve is unpacked,
// transformed and packed again.
Affine compose(const Affine& outer, const Quadric& quadric, const Affine& place);

// Returns whether the map mirrors: triangles then have to be wound the other way for their fronts to stay
// fronts.
bool mirrors(const Affine& m);

// Returns where a vertex of an object stands, rounded once, with −0 made 0.
Point3f placed(const Affine& m, Point3f p);

// Returns a box, rounded outwards, that holds the placed image of all that lies in `box`.
Bounds3f placed_bounds(const Affine& m, const Bounds3f& box);

// Returns the code (encode_normal) of the placed shading normal.
std::uint32_t placed_normal(const Affine& m, std::uint32_t code);

// Returns the corner of an object's triangle that becomes corner k of the placed one.
constexpr std::size_t source_corner(bool mirrored, std::size_t k) { return mirrored && k > 0 ? 3 - k : k; }

// An InstanceRef places an object in its parent, which is an object or, in a domain, the scene.
struct InstanceRef {
  Affine to_parent{};  // to the parent's coordinates; of a curve, itself in them (scene/shapes/curve.h)
  // This box, in the parent's coordinates and inflated, holds all that is wanted of the instance: in a
  // domain, the part in its cell.
  float lower[3] = {}, upper[3] = {};
  std::uint32_t object = 0;          // number of the object
  std::uint32_t first_triangle = 0;  // the id of the object's triangle 0 in the parent
};
static_assert(sizeof(InstanceRef) == 128);

Bounds3f box_of(const InstanceRef& ref);
void set_box(InstanceRef& ref, const Bounds3f& box);

}  // namespace vitrail
