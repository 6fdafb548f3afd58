// SPDX-License-Identifier: Apache-2.0
// These are pictures of all directions: points (x,y) in [0,1]², y down from the top, in either of the
// projections of an EnvironmentLight.
#pragma once

#include "scene/records/light.h"

namespace vitrail {

using SphereProjection = EnvironmentLight::Projection;

// `direction` is unit.
Point2d sphere_point(SphereProjection projection, Vector3d direction);
Vector3d sphere_direction(SphereProjection projection, Point2d point);

}  // namespace vitrail
