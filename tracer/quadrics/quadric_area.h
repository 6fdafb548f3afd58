// SPDX-License-Identifier: Apache-2.0
// This file has quadrics by area, in their own space: (s,t) is in the unit square, where equal areas are
// equal areas of the surface. s = φ/phi_max. t goes with z, on a disk outwards, on a cone from its tip to its
// base.
#pragma once

#include "bundle/instance.h"
#include "scene/shapes/quadric.h"

namespace vitrail {

double own_area(const Quadric& quadric);
Point3d point_by_area(const Quadric& quadric, double s, double t);
// Returns the (s,t) of a point of the quadric, to rounding.
Point2d place_by_area(const Quadric& quadric, Point3d local);
// Returns how much larger than in their own space surfaces are where they stand with that normal.
double area_stretch(const Affine& to_bundle, Vector3d unit_normal);

}  // namespace vitrail
