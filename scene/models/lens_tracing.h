// SPDX-License-Identifier: Apache-2.0
// These functions trace rays through the surfaces of a lens, in doubles and with nothing but + − · / √: alike
// on every machine.
#pragma once

#include <optional>
#include <span>

#include "scene/records/camera.h"

namespace vitrail {

// Returns the distance from the camera's origin, the middle of the film, to the lens's rear vertex.
double rear_vertex(std::span<const LensSurface> surfaces);

// It is a ray that leaves the lens, in camera space.
struct LensRay {
  Point3d origin;
  Vector3d direction;  // unit
};

// Traces a ray from a point of the film towards a point of the plane of the rear vertex. It returns nothing
// where the rim of a surface, the stop, or total reflection holds the ray up.
std::optional<LensRay> through_lens(std::span<const LensSurface> surfaces, Point3d film, Point2d rear);

// Returns cos⁴θ, where θ is the angle between the axis and the ray from `film` to `rear`.
double cosine_4(Point2d film, Point2d rear, double rear_z);

// Divides the film into rings, equally wide, the last of which ends at `film_radius`. For each it returns a
// rectangle that holds the rays that come through, as RealisticCamera has it. As pbrt does, a little is added
// on each side.
std::vector<ExitPupil> exit_pupils(std::span<const LensSurface> surfaces, double film_radius);

// Returns the mean of cos⁴θ over rays spread evenly from a point of the film to the rectangle; rays that do
// not come through count as 0.
double mean_weight(std::span<const LensSurface> surfaces, Point2d film, const ScreenWindow& rectangle);

}  // namespace vitrail
