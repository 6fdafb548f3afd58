// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>

#include "scene/records/scene.h"
#include "tracer/rays/direction.h"

namespace vitrail {

struct CameraRay {
  Point3f origin;
  DirectionCode direction;
  double weight = 1;  // of what it brings; 0: the lens lets nothing through
  double before = 0;  // the way from the camera to `origin`, which its near plane cuts off
  double end = std::numeric_limits<double>::infinity();  // at its far plane, in lengths of the direction
};

class CameraSampler {
 public:
  // All of them have to outlive it.
  CameraSampler(const Camera& camera, const Motion& motion, const FilmSettings& film);

  // It is linear in the raster position: at_corner + per_x·x + per_y·y.
  struct Linear {
    Vector3d at_corner, per_x, per_y;
    Vector3d at(Point2d raster) const { return at_corner + per_x * raster.x + per_y * raster.y; }
  };
  // They are where rays start, and their directions of any length.
  struct LinearRays {
    Linear origin, direction;
  };
  // Returns the rays of a pinhole and of parallel rays that stand still, without clip planes; null for other
  // cameras.
  const LinearRays* linear() const { return is_linear_ ? &linear_ : nullptr; }

  // Returns whether rays need a point of the lens.
  bool has_lens() const { return has_lens_; }
  // Returns the ray through raster position (x, y), in pixels of the whole film from the top left. `lens`, in
  // [0,1)², chooses the point of the lens, if there is one. `time_s` matters where the camera moves.
  CameraRay ray(Point2d raster, Point2d lens, double time_s) const;
  // Returns where in the raster a point is seen at a time, without a lens. None: it is behind the camera, or
  // the camera is neither a perspective nor an orthographic one.
  std::optional<Point2d> raster(Point3d p, double time_s) const;
  // Returns the sensor of a column, where the camera is one of sensors: its place and its unit normal.
  std::optional<Sensor> sensor(int x) const;

 private:
  const Camera& camera_;
  const Motion& motion_;
  const FilmSettings& film_;
  bool has_lens_ = false;
  bool clips_ = false;  // near or far
  bool is_linear_ = false;
  LinearRays linear_;
};

// Maps the square [0,1]² to the unit disk, area by area, neighbours staying neighbours (Shirley & Chiu 1997).
Point2d concentric_disk(Point2d u);

}  // namespace vitrail
