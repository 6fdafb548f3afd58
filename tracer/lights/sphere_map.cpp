// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/sphere_map.h"

#include "tracer/lights/sphere_map_lanes.h"

namespace vitrail {

Point2d sphere_point(SphereProjection projection, Vector3d d) {
  const lanes::PicturePoint<double> point = lanes::sphere_point<double>(projection, {d.x, d.y, d.z});
  return {point.x, point.y};
}

Vector3d sphere_direction(SphereProjection projection, Point2d point) {
  if (projection == SphereProjection::equal_area)
    return lanes::lane(lanes::equal_area_direction<double>({point.x, point.y}), 0);
  const double polar = point.y * pi, turn = point.x * 2 * pi, across = portable_sin(polar);
  return {across * portable_cos(turn), across * portable_sin(turn), portable_cos(polar)};
}

}  // namespace vitrail
