// SPDX-License-Identifier: Apache-2.0
// This file reads and focusses the lens of pbrt's realistic camera.
#pragma once

#include <filesystem>
#include <vector>

#include "scene/records/camera.h"

namespace vitrail::pbrt {

// Reads a file that has, from the scene to the film, each surface's radius of curvature (0: the stop),
// distance to the next, index behind it and diameter, in mm. The result is in metres. `aperture_mm`, if it is
// less than the file's, is the stop's diameter. Throws Error for files that are no such list, and for lenses
// that do not gather light.
std::vector<LensSurface> read_lens(const std::filesystem::path& file, double aperture_mm);

// It is the lens so far from the film that what is `focus_distance` from the film is sharp, and what its film
// of `film_diagonal` sees. All lengths are in metres. `by_area`: samples count by the size of the rectangle
// that they are of, as in pbrt-v4 (and in v3 without simpleweighting), else they all count alike. Throws
// Error where nothing so near is sharp, or where no light comes to the middle of the film.
struct FocussedLens {
  std::vector<LensSurface> surfaces;
  std::vector<ExitPupil> pupils;
  double middle =
      0;  // what the middle of the film gets of a radiance of 1; the weights of pupils are over it
};
FocussedLens focussed(std::vector<LensSurface> surfaces, double focus_distance, double film_diagonal,
                      bool by_area);

}  // namespace vitrail::pbrt
