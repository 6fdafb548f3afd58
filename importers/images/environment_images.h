// SPDX-License-Identifier: Apache-2.0
// These functions handle pictures of all directions, in either of the projections of an EnvironmentLight.
#pragma once

#include "scene/records/image.h"
#include "scene/records/light.h"

namespace vitrail {

using EnvironmentProjection = EnvironmentLight::Projection;

// They convert a point of the picture, (x,y) in [0,1]², y down from the top, to its unit direction, and back.
Vector3d direction_of(EnvironmentProjection projection, Point2d point);
Point2d point_of(EnvironmentProjection projection, Vector3d direction);

// Returns the middle of pixel (x,y) of a picture: the first and the last row of latitude and longitude lie on
// the poles, as in Mitsuba. Fractions are places between.
Point2d pixel_point(EnvironmentProjection projection, int width, int height, double x, double y);

// Returns the picture at a point, as it is rendered: the pixel there of the equal-area map, bilinear by
// latitude and longitude. `channel` < image.channels.
double environment_lookup(const Image& image, EnvironmentProjection projection, Point2d point, int channel);

// Returns the same radiance in the other projection: every pixel is the mean over its solid angle. It is
// twice as high, of 256 to 4096 rows or as many as it had; twice as wide as high by latitude and longitude,
// square for the equal-area map.
Image reproject(const Image& image, EnvironmentProjection from, EnvironmentProjection to);

// Returns ∫ L cos θ dω over the directions with z > 0, of luminance L = Y of linear sRGB: the illuminance of
// a plane that faces up.
double upward_illuminance(const Image& image, EnvironmentProjection projection);
// Returns ∫ L dω over all directions.
double total_flux(const Image& image, EnvironmentProjection projection);

}  // namespace vitrail
