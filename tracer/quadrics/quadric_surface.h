// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bundle/instance.h"
#include "bundle/oriented_quadric.h"

namespace vitrail {

// A point of a quadric where it stands.
struct QuadricPoint {
  Point3d p;
  Vector3d normal;      // unit, of the front
  Vector3d shading;     // the same, but of a curve: perpendicular to the curve itself
  Vector3d dpdu, dpdv;  // 0 where (u,v) do not span a plane: at poles
  Point2d uv;
};

Point3d placed_point(const Affine& to_bundle, Point3d local);
// Unit, of the front.
Vector3d placed_quadric_normal(const OrientedQuadric& quadric, const Affine& to_bundle, Point3d local);
// `local` on the surface, in the quadric's own space. (u,v) of what is no curve cost two arctangents, and are
// left 0 unless they show.
QuadricPoint quadric_point(const OrientedQuadric& quadric, const Affine& to_bundle, Point3d local,
                           bool uvs_show = true);

}  // namespace vitrail
