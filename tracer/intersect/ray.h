// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "bundle/domain_file.h"
#include "scene/vec.h"

namespace vitrail {

// Points o + t·d, t in (0, ∞). `direction` is finite and not zero; it need not be of unit length.
struct Ray {
  Point3f origin;
  Vector3f direction;
  std::uint32_t exclude = no_triangle;  // the triangle the ray starts on: never hit
};

// The best hit so far: least (t, triangle). t = ∞ and no_triangle: none.
// `cluster` and `lane` say where the domain that found it holds the triangle; u, v are barycentric:
// p = (1−u−v)·v0 + u·v1 + v·v2.
struct Hit {
  double t = __builtin_inf();
  std::uint32_t triangle = no_triangle;
  std::uint32_t cluster = 0;
  std::uint32_t lane = 0;
  double u = 0, v = 0;
};

}  // namespace vitrail
