// SPDX-License-Identifier: Apache-2.0
// These functions describe a lens of many surfaces by its rays near the axis.
#pragma once

#include <optional>
#include <span>

#include "scene/records/camera.h"
#include "scene/records/film_settings.h"

namespace vitrail {

// It says how a system of lenses in air bends rays near its axis. Lengths are in the unit of the surfaces.
struct ThinLens {
  double focal_length = 0;
  double principal_gap = 0;   // from the front principal plane to the rear one
  double rear_principal = 0;  // the rear principal plane, from the rear vertex towards the film
  double pupil_radius = 0;    // of the entrance pupil
};

// Throws Error where there is no stop, or the lens does not gather light.
ThinLens thin_lens(std::span<const LensSurface> surfaces);

// Returns the distance from the rear principal plane to the film at which an object is sharp. The object is
// at `distance` from the film. It returns nothing where nothing so near can be sharp.
std::optional<double> image_distance(const ThinLens& lens, double distance);

// Returns the camera without distortion and without darker corners: a thin lens of the same focal length and
// pupil, that is in focus where it is. Its middle is as bright.
PerspectiveCamera view_of(const RealisticCamera& camera, const FilmSettings& film);

// Returns half the film's width and height. The rule is pbrt's: the diagonal is given, the pixels are square.
Point2d half_film(const RealisticCamera& camera, const FilmSettings& film);

}  // namespace vitrail
