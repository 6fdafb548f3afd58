// SPDX-License-Identifier: Apache-2.0
// This class computes how bright each patch of the sky is.
#pragma once

#include <vector>

#include "scene/daylight/sky_patches.h"
#include "scene/records/light.h"

namespace vitrail {

// It computes the means of skies over patches, by points that are spread over each.
class PatchSkies {
 public:
  explicit PatchSkies(const SkyPatches& patches);

  // Returns the mean luminance of each patch, cd/m², by its number. Together they give the distribution's
  // illuminance on a horizontal plane. The ground, which is the first, is left at 0. `to_sun`: unit, in the
  // frame of SkyPatches.
  std::vector<double> luminances(const SkyDistribution& sky, Vector3d to_sun) const;

 private:
  struct Point {
    Vector3d direction;
    std::size_t height = 0;  // index of its z
  };
  std::size_t points_a_patch_ = 0;
  std::vector<Point> points_;  // of patch 1, of patch 2 …
  std::vector<double> heights_;
  std::vector<double> horizontal_;  // lx of 1 cd/m² of each patch, on a horizontal plane
};

}  // namespace vitrail
