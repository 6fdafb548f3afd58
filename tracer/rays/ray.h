// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "bundle/domain_file.h"
#include "scene/geometry/vec.h"

namespace vitrail {

// A Ray has the points o + t·d, t in (0, ∞). `direction` is finite and not zero; it need not be of unit
// length.
struct Ray {
  Point3f origin;
  Vector3f direction;
  std::uint32_t exclude = no_triangle;  // the triangle the ray starts on: never hit
};

// It is the best hit so far: least (t, triangle). t = ∞ and no_triangle: none. `cluster` and `lane` say where
// the domain that found it holds the triangle. Where depth > 0, they are in the object of the last of the
// instances chain[0 … depth), each an index in the one before. u, v are barycentric:
// p = (1−u−v)·v0 + u·v1 + v·v2. A hit of a quadric has in (u, v, w) the point in its own space.
struct Hit {
  double t = __builtin_inf();
  std::uint32_t triangle = no_triangle;
  std::uint32_t cluster = 0;
  std::uint32_t lane = 0;
  std::uint32_t depth = 0;
  double u = 0, v = 0, w = 0;
  std::uint32_t chain[max_instance_depth] = {};
};

// It holds what every traversal of every domain needs of a ray, computed once by `prepare`. z is the axis of
// the direction's greatest component, x and y the next ones. Distances inside a traversal are ζ = t·|d_z|, in
// units of the scene whatever the length of the direction.
struct RayConstants {
  float origin[3];             // by axis
  float inverse_direction[3];  // |d_z|/d_a, its magnitude at most 1e18
  std::uint32_t
      near_row[3];  // the row of a BvhNode's boxes where the ray enters on this axis: 0–2 lower, 3–5 upper
  std::uint32_t x, y, z;   // axes
  float shear_x, shear_y;  // d_x/d_z, d_y/d_z
  float sign_z;            // of d_z, ±1
  float drift;  // 2⁻⁴⁷ of the origin's greatest |coordinate|: keeps a ray in the slab that it is parallel to
  std::uint32_t exclude;
  double exact_shear_x, exact_shear_y;
  double direction_z;  // d_z
  double time_s;       // where anything moves
};
RayConstants prepare(const Ray& ray, double time_s = 0);

}  // namespace vitrail
