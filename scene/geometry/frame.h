// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "scene/geometry/transform.h"
#include "scene/geometry/vec.h"

namespace vitrail {

// It is an orthonormal frame around a unit normal (Duff et al. 2017, listing 3).
struct Frame {
  Vector3d tangent, bitangent, normal;
  explicit Frame(Vector3d n) : normal(n) {
    const double sign = std::copysign(1.0, n.z);  // 1 + |n.z| ≥ 1
    const double a = -1 / (sign + n.z), b = n.x * n.y * a;
    tangent = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
  }
  Vector3d to_world(Vector3d local) const {
    return tangent * local.x + bitangent * local.y + normal * local.z;
  }
};

// Returns the transform from the frame's coordinates to the world's.
inline Transform transform_of(const Frame& f) {
  const Vector3d &x = f.tangent, &y = f.bitangent, &z = f.normal;
  return {{{{x.x, y.x, z.x, 0}, {x.y, y.y, z.y, 0}, {x.z, y.z, z.z, 0}, {0, 0, 0, 1}}}};
}

}  // namespace vitrail
