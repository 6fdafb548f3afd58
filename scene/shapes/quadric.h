// SPDX-License-Identifier: Apache-2.0
// These surfaces of revolution of the second order are kept as what they are.
#pragma once

#include <cstdint>

#include "scene/geometry/bounds.h"
#include "scene/geometry/transform.h"

namespace vitrail {

enum class QuadricKind : std::uint8_t { sphere, cylinder, disk, cone, paraboloid, curve };

// It says how (u,v) run, with φ from +x towards +y:
//   pbrt     u = φ/phi_max; v runs from 0 to 1: with the polar angle from low to high (sphere), from the edge
//            to `low` (disk), with z (others); of a curve u runs along it and v around
//   mitsuba  as pbrt's, but of a sphere v = 1 − v, and of a disk (ρ, φ/phi_max), of a curve (around, along)
enum class QuadricUv : std::uint8_t { pbrt, mitsuba };

// It is in its own space, about z, where 0 ≤ φ ≤ phi_max; sizes are its transform's:
//   sphere      x² + y² + z² = 1,    low ≤ z ≤ high
//   cylinder    x² + y² = 1,         0 ≤ z ≤ 1
//   disk        z = 0,               low ≤ ρ ≤ 1, ρ² = x² + y²
//   cone        x² + y² = (1 − z)²,  0 ≤ z ≤ 1
//   paraboloid  x² + y² = z,         low ≤ z ≤ 1
//   curve       no quadric: its place is all of it (scene/shapes/curve.h)
// The front is outside, of a disk +z; as of triangles, a transform that mirrors swaps the sides.
struct Quadric {
  QuadricKind kind = QuadricKind::sphere;
  QuadricUv uv = QuadricUv::pbrt;
  double low = -1, high = 1;  // what a kind above does not mention is −1 and 1
  double phi_max_rad = 6.283185307179586;
  bool operator==(const Quadric&) const = default;
};

// Returns whether the quadric goes all the way round.
bool is_whole_turn(const Quadric& quadric);
// Returns whether it is a sphere without a hole.
bool is_whole_sphere(const Quadric& quadric);

// Returns whether its place is a packed curve, and no matrix.
inline bool is_curve(const Quadric& quadric) { return quadric.kind == QuadricKind::curve; }

// Returns a box that holds the surface where an affine transform puts it; it is tight where the quadric goes
// all the way round.
Bounds3d bounds_of(const Quadric& quadric, const Transform& to);

}  // namespace vitrail
