// SPDX-License-Identifier: Apache-2.0
// A camera says from where and through what the picture is taken.
#pragma once

#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

#include "scene/geometry/transform.h"

namespace vitrail {

// It is a window of camera space: +z is the view, +x raster right, +y up. The raster covers `screen` (in
// units of the plane z = 1 for the perspective camera, of the world for the orthographic one): x0 at the left
// edge, y1 at the top.
struct ScreenWindow {
  double x0 = -1, x1 = 1, y0 = -1, y1 = 1;
  bool operator==(const ScreenWindow&) const = default;
};

// Rays start on a disk of `radius` around the camera's origin and meet in the plane z = `focal_distance`.
struct Lens {
  double radius = 0;  // 0: a pinhole, everything is in focus
  double focal_distance = 1e6;
  bool operator==(const Lens&) const = default;
};

// It gives depths along the axis, in camera space: a ray of the camera begins at `near` and meets no surface
// from `far` on. The surroundings of the scene are seen behind it.
struct ClipRange {
  float near = 0, far = std::numeric_limits<float>::infinity();  // these: nothing is cut away
  bool operator==(const ClipRange&) const = default;
};

// It is a pinhole, or a thin lens.
struct PerspectiveCamera {
  Transform camera_to_world;
  ScreenWindow screen;  // tan of the half angles: ±tan(fov/2) on the axis that fov measures
  Lens lens;
  ClipRange clip{};
  bool operator==(const PerspectiveCamera&) const = default;
};

// It sees along parallel rays.
struct OrthographicCamera {
  Transform camera_to_world;
  ScreenWindow screen;
  Lens lens;
  ClipRange clip{};
  bool operator==(const OrthographicCamera&) const = default;
};

// It sees the whole sphere of directions around the camera, +y up: by latitude and longitude, or the
// equal-area octahedral map.
struct SphericalCamera {
  enum class Projection : std::uint8_t { equal_area, latitude_longitude };
  Transform camera_to_world;
  Projection projection = Projection::equal_area;
  bool operator==(const SphericalCamera&) const = default;
};

// It is one of the irradiance meters that take the place of a picture. Column x of the raster is sensor x.
// Every row repeats it with samples of its own, so that the rows give the error of their mean. A sensor is a
// white diffuse surface that is seen: its radiance times π, the film's imaging ratio, is the irradiance.
struct Sensor {
  Point3d position;          // in camera space
  Vector3d normal{0, 0, 1};  // unit
  bool operator==(const Sensor&) const = default;
};
// It measures irradiance at points.
struct SensorCamera {
  Transform camera_to_world;
  std::vector<Sensor> sensors;
  bool operator==(const SensorCamera&) const = default;
};

// It is one surface of a lens of many surfaces before a film (Kolb, Mitchell, Hanrahan 1995), as pbrt's. The
// film is in the plane z = 0, its middle at the origin.
struct LensSurface {
  double radius = 0;     // of curvature; above 0: its centre is on the film's side. 0: the stop, a plane
  double thickness = 0;  // to the next surface towards the film; of the last, to the film
  double index = 1;      // of refraction, towards the film
  double aperture_radius = 0;
  bool operator==(const LensSurface&) const = default;
};
// It belongs to a ring of the film: the part of the plane at the lens's last vertex that the ring's rays aim
// at, and the weight of each ray beside cos⁴θ. The rectangle is that of a point on the x axis, and turns with
// the point.
struct ExitPupil {
  ScreenWindow rectangle{0, 0, 0, 0};
  double weight = 0;
  bool operator==(const ExitPupil&) const = default;
};
// It is a lens of several surfaces, as pbrt's.
struct RealisticCamera {
  Transform camera_to_world;
  double film_diagonal = 0;
  std::vector<LensSurface> surfaces;  // from the scene to the film
  std::vector<ExitPupil> pupils;      // of rings of the film, equally wide, out to half the diagonal
  bool operator==(const RealisticCamera&) const = default;
};

// It sees more around the camera than a plane shows, as POV-Ray's cameras do. The raster is x from −1 at its
// left to 1 and y from −1 at its bottom to 1. X = x·across and Y = y·above are degrees but where it says so.
// Its directions follow.
struct WideCamera {
  enum class Projection : std::uint8_t {
    latitude_longitude,  // longitude X, latitude Y
    fisheye,           // √(X² + Y²) away from the view, towards (X, Y); nothing is seen beyond `edge_deg`
    ultra_wide,        // (sin X, sin Y, cos X·cos Y)
    panoramic,         // (across·sin 90°x, above·tan 90°y, cos 90°x): both are lengths
    upright_cylinder,  // longitude X; as high as Y, a length, at a distance of 1
    lying_cylinder,    // the same with the axes exchanged
  };
  Transform camera_to_world;
  Projection projection = Projection::latitude_longitude;
  double across = 180, above = 90;
  double edge_deg = 180;
  bool parallel = false;  // of a cylinder: the camera moves along its axis by the length, and looks across it
  bool operator==(const WideCamera&) const = default;
};

using Camera = std::variant<PerspectiveCamera, OrthographicCamera, SphericalCamera, SensorCamera,
                            RealisticCamera, WideCamera>;

// Returns the camera's range; other cameras have no planes.
inline ClipRange clip_of(const Camera& camera) {
  if (const auto* c = std::get_if<PerspectiveCamera>(&camera)) return c->clip;
  if (const auto* c = std::get_if<OrthographicCamera>(&camera)) return c->clip;
  return {};
}

}  // namespace vitrail
