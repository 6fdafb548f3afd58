// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"
#include "tracer/direction.h"

namespace vitrail {

// Inverse cumulative distributions of a separable reconstruction filter, so that a sample lands in one pixel
// with weight 1 (Ernst, Stamminger & Greiner 2006).
class FilterSampler {
 public:
  explicit FilterSampler(const Filter& filter);
  // Offset from the pixel's centre, in pixels, for u, v in [0,1).
  Point2d sample(float u, float v) const;

 private:
  static constexpr std::size_t resolution = 256;
  struct Axis {
    double radius = 0;
    std::vector<double> cumulative;  // resolution + 1 values from 0 to 1; empty: uniform
    double sample(double u) const;
  };
  Axis x_, y_;
};

struct CameraRay {
  Point3f origin;
  DirectionCode direction;
};

// The ray through raster position (x, y), in pixels of the whole film from the top left.
CameraRay camera_ray(const Camera& camera, const FilmSettings& film, Point2d raster);

}  // namespace vitrail
