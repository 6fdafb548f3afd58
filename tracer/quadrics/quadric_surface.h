// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bundle/instance.h"
#include "bundle/oriented_quadric.h"

namespace vitrail {

// It is a point of a quadric where it stands.
struct QuadricPoint {
  Point3d p;
  Vector3d normal;      // unit, of the front
  Vector3d shading;     // the same, but of a curve: perpendicular to the curve itself
  Vector3d dpdu, dpdv;  // 0 where (u,v) do not span a plane: at poles
  Point2d uv;
};

Point3d placed_point(const Affine& to_bundle, Point3d local);
// Returns the unit normal of the front.
Vector3d placed_quadric_normal(const OrientedQuadric& quadric, const Affine& to_bundle, Point3d local);
// `local` is on the surface, in the quadric's own space. The (u,v) of a quadric that is no curve cost two
// arctangents; they are left 0 unless `uvs_show`.
QuadricPoint quadric_point(const OrientedQuadric& quadric, const Affine& to_bundle, Point3d local,
                           bool uvs_show = true);

}  // namespace vitrail
