// SPDX-License-Identifier: Apache-2.0
// Rays through the surfaces of a lens, in doubles and with nothing but + − · / √: alike on every machine.
#pragma once

#include <optional>
#include <span>

#include "scene/records/camera.h"

namespace vitrail {

// From the camera's origin, the middle of the film, to the lens's rear vertex.
double rear_vertex(std::span<const LensSurface> surfaces);

// Where a ray leaves the lens, in camera space.
struct LensRay {
  Point3d origin;
  Vector3d direction;  // unit
};

// From a point of the film, towards a point of the plane of the rear vertex. Empty: it is held up, by the rim
// of a surface, by the stop, or by total reflection.
std::optional<LensRay> through_lens(std::span<const LensSurface> surfaces, Point3d film, Point2d rear);

// cos⁴θ of the ray between them and the axis.
double cosine_4(Point2d film, Point2d rear, double rear_z);

// Of rings of a film, equally wide, the last of which ends at `film_radius`: a rectangle that rays which come
// through are in, as RealisticCamera has it. As pbrt does, a little is added on each side.
std::vector<ExitPupil> exit_pupils(std::span<const LensSurface> surfaces, double film_radius);

// Of rays from a point of the film to the rectangle, evenly: the mean of cos⁴θ, 0 of what does not come
// through.
double mean_weight(std::span<const LensSurface> surfaces, Point2d film, const ScreenWindow& rectangle);

}  // namespace vitrail
