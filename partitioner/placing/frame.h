// SPDX-License-Identifier: Apache-2.0
// This file decides where the coordinates of a bundle begin. A float there is off by up to 2⁻²⁴ of its
// distance from that origin. So one triangle far away must not move it away from all others.
#pragma once

#include <optional>
#include <vector>

#include "scene/geometry/bounds.h"
#include "scene/records/camera.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// Returns the greatest of |x|, |y| and |z|.
double greatest(Vector3d v);

// A FramePart is what lies in one place, in the coordinates that the origin is sought in.
struct FramePart {
  Point3d centre;
  double radius = 0;  // about which, on the greatest axis, half of it lies
  double triangles = 0;
};

// A Viewpoint is from where a picture sees parts: a point, or all points of an axis.
struct Viewpoint {
  Point3d at;
  std::optional<Vector3d> along;  // unit length
};
Viewpoint viewpoint_of(const Camera& camera);

// Returns the middle of `box`, which holds all parts, if nearly all weight is in parts within `near_radii`
// times their radius of it. Rounding then moves vertices by 2⁻¹⁶ of that radius at most. Else returns the
// middle by weight, if that has less far away: triangles count, and those seen large count most.
Point3d origin_of(const std::vector<FramePart>& parts, const Bounds3d& box,
                  const std::optional<Viewpoint>& eye);

// Returns the middle part, and the radius about it that half of the triangles lie in.
FramePart whole_of(const std::vector<FramePart>& parts);

}  // namespace vitrail
