// SPDX-License-Identifier: Apache-2.0
// Pictures of all directions, in either of the projections of an EnvironmentLight.
#pragma once

#include "scene/records/image.h"
#include "scene/records/light.h"

namespace vitrail {

using EnvironmentProjection = EnvironmentLight::Projection;

// The unit direction of a point of the picture, (x,y) in [0,1]², y down from the top; and back.
Vector3d direction_of(EnvironmentProjection projection, Point2d point);
Point2d point_of(EnvironmentProjection projection, Vector3d direction);

// The picture at a point: bilinear between the centres of its pixels, going on across the edges as the sphere
// does. `channel` < image.channels.
double environment_lookup(const Image& image, EnvironmentProjection projection, Point2d point, int channel);

// The same radiance in the other projection: every pixel is the mean over its solid angle. Height as before;
// twice as wide by latitude and longitude, square for the equal-area map.
Image reproject(const Image& image, EnvironmentProjection from, EnvironmentProjection to);

// ∫ L cos θ dω over the directions with z > 0, of luminance L = Y of linear sRGB: the illuminance of a plane
// that faces up.
double upward_illuminance(const Image& image, EnvironmentProjection projection);

}  // namespace vitrail
