// SPDX-License-Identifier: Apache-2.0
// Where the coordinates of a bundle begin. A float there is off by up to 2⁻²⁴ of its distance from it, so one
// triangle far away must not move it away from all others.
#pragma once

#include <optional>
#include <vector>

#include "scene/geometry/bounds.h"
#include "scene/records/camera.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// Returns the greatest of |x|, |y| and |z|.
double greatest(Vector3d v);

// What lies in one place, in the coordinates that the origin is sought in.
struct FramePart {
  Point3d centre;
  double radius = 0;  // about which, on the greatest axis, half of it lies
  double triangles = 0;
};

// From where a picture sees parts: a point, or all points of an axis.
struct Viewpoint {
  Point3d at;
  std::optional<Vector3d> along;  // unit length
};
Viewpoint viewpoint_of(const Camera& camera);

// The middle of `box`, which holds all parts, where nearly all that counts is within `near_radii` of its own
// from it: rounding moves its vertices by 2⁻¹⁶ of its radius at most. Else the middle one of what counts: of
// triangles, and of those seen the ones that are seen large.
Point3d origin_of(const std::vector<FramePart>& parts, const Bounds3d& box,
                  const std::optional<Viewpoint>& eye);

// The middle part, and the radius about it that half of the triangles lie in.
FramePart whole_of(const std::vector<FramePart>& parts);

}  // namespace vitrail
