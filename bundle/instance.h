// SPDX-License-Identifier: Apache-2.0
// Objects and their instances. An object has vertices of its own, rounded to float around its own centre; an
// instance says where it stands. What stands in the world is decided here and nowhere else, so that a scene
// whose instances are kept and the same scene flattened have the same triangles, to the last bit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/geometry/bounds.h"
#include "scene/geometry/transform.h"
#include "scene/geometry/vec.h"
#include "scene/shapes/quadric.h"

namespace vitrail {

// Most instances within each other; one more than of prototypes, for the quadrics in them.
inline constexpr int max_instance_depth = 9;

// p' = m·(p, 1), m[row][column].
struct Affine {
  double m[3][4];
};

// Of a transform whose last row is 0 0 0 1.
Affine affine(const Transform& t);
bool is_affine(const Transform& t);

// a∘b. The matrix of a chain of instances is ((m₁∘m₂)∘m₃)∘…
Affine compose(const Affine& a, const Affine& b);

// A place of the quadric taken through `outer`: as matrices are, or as a curve is.
Affine compose(const Affine& outer, const Quadric& quadric, const Affine& place);

// Whether triangles have to be wound the other way for their fronts to stay their fronts.
bool mirrors(const Affine& m);

// Where a vertex of an object stands: rounded once, −0 made 0.
Point3f placed(const Affine& m, Point3f p);

// Holds where all that lies in the box stands, rounded outwards.
Bounds3f placed_bounds(const Affine& m, const Bounds3f& box);

// The code (encode_normal) of a shading normal there.
std::uint32_t placed_normal(const Affine& m, std::uint32_t code);

// The corner of an object's triangle that corner k of the placed one comes from.
constexpr std::size_t source_corner(bool mirrored, std::size_t k) { return mirrored && k > 0 ? 3 - k : k; }

// An object where it stands in its parent, which is an object or, in a domain, the scene.
struct InstanceRef {
  Affine to_parent{};  // to the parent's coordinates; of a curve, itself in them (scene/shapes/curve.h)
  // Holds all that is wanted of it, in the parent's coordinates: in a domain, the part in its cell; inflated.
  float lower[3] = {}, upper[3] = {};
  std::uint32_t object = 0;          // number of the object
  std::uint32_t first_triangle = 0;  // the id of the object's triangle 0 in the parent
};
static_assert(sizeof(InstanceRef) == 128);

Bounds3f box_of(const InstanceRef& ref);
void set_box(InstanceRef& ref, const Bounds3f& box);

}  // namespace vitrail
