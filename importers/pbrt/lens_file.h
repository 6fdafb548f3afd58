// SPDX-License-Identifier: Apache-2.0
// The lens of pbrt's realistic camera by its paraxial rays.
#pragma once

#include <filesystem>

namespace vitrail::pbrt {

// What a system of lenses in air does to rays near its axis. Lengths in mm.
struct ThinLens {
  double focal_length = 0;
  double principal_gap = 0;  // from the front principal plane to the rear one
  double pupil_radius = 0;   // of the entrance pupil
};

// Of a file that has, from the scene to the film, each surface's radius of curvature (0: the stop), distance
// to the next, index behind it and diameter. `aperture_mm`, if it is less than the file's, is the stop's
// diameter. Throws Error for files that are no such list, and for lenses that do not gather light.
ThinLens read_lens(const std::filesystem::path& file, double aperture_mm);

// From the rear principal plane to the film that is sharp for what is `distance_mm` from it, the film.
double image_distance(const ThinLens& lens, double distance_mm);

}  // namespace vitrail::pbrt
