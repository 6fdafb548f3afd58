// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"
#include "tracer/direction.h"

namespace vitrail {

struct CameraRay {
  Point3f origin;
  DirectionCode direction;
};

// Whether rays of the camera need a point of its lens.
bool has_lens(const Camera& camera);

// The ray through raster position (x, y), in pixels of the whole film from the top left. `lens`, in [0,1)²,
// chooses the point of the lens, if there is one.
CameraRay camera_ray(const Camera& camera, const FilmSettings& film, Point2d raster, Point2d lens);

// The square [0,1]² to the unit disk, area by area, neighbours staying neighbours (Shirley & Chiu 1997).
Point2d concentric_disk(Point2d u);

}  // namespace vitrail
