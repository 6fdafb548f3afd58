// SPDX-License-Identifier: Apache-2.0
// A lens of many surfaces by its rays near the axis.
#pragma once

#include <optional>
#include <span>

#include "scene/records/camera.h"
#include "scene/records/film_settings.h"

namespace vitrail {

// What a system of lenses in air does to rays near its axis. Lengths as of its surfaces.
struct ThinLens {
  double focal_length = 0;
  double principal_gap = 0;   // from the front principal plane to the rear one
  double rear_principal = 0;  // the rear principal plane, from the rear vertex towards the film
  double pupil_radius = 0;    // of the entrance pupil
};

// Throws Error for what has no stop, or does not gather light.
ThinLens thin_lens(std::span<const LensSurface> surfaces);

// From the rear principal plane to the film that is sharp for what is at `distance` from it, the film. Empty:
// nothing so near is sharp.
std::optional<double> image_distance(const ThinLens& lens, double distance);

// The camera without distortion and without darker corners: a thin lens of the same focal length and pupil,
// that is in focus where it is. Its middle is as bright.
PerspectiveCamera view_of(const RealisticCamera& camera, const FilmSettings& film);

// Of the film: half its width and height. pbrt's rule: the diagonal is given, the pixels are square.
Point2d half_film(const RealisticCamera& camera, const FilmSettings& film);

}  // namespace vitrail
