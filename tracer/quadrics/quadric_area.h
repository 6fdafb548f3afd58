// SPDX-License-Identifier: Apache-2.0
// Quadrics by area, in their own space: (s,t) in the unit square, where equal areas are equal areas of the
// surface. s = φ/phi_max; t goes with z, of a disk outwards, of a cone from its tip to its base.
#pragma once

#include "bundle/instance.h"
#include "scene/shapes/quadric.h"

namespace vitrail {

double own_area(const Quadric& quadric);
Point3d point_by_area(const Quadric& quadric, double s, double t);
// The (s,t) of a point of it, to rounding.
Point2d place_by_area(const Quadric& quadric, Point3d local);
// By how much larger than in their own space surfaces are where they stand, of that normal there.
double area_stretch(const Affine& to_bundle, Vector3d unit_normal);

}  // namespace vitrail
