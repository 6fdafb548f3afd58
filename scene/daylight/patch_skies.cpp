// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/patch_skies.h"

#include <algorithm>

#include "scene/daylight/sky_distribution.h"

namespace vitrail {

PatchSkies::PatchSkies(const SkyPatches& patches) : horizontal_(patches.count()) {
  // About as close to each other whatever the patches are.
  const int side = std::max(2, 8 / patches.mf());
  points_a_patch_ = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  for (std::size_t patch = 1; patch < patches.count(); ++patch) {
    double height = 0;
    for (int i = 0; i < side * side; ++i) {
      points_.push_back(patches.direction(patch, (i % side + 0.5) / side, (i / side + 0.5) / side));
      height += points_.back().z;
    }
    horizontal_[patch] = patches.solid_angle(patch) * height / static_cast<double>(points_a_patch_);
  }
}

std::vector<double> PatchSkies::luminances(const SkyDistribution& sky, Vector3d to_sun) const {
  std::vector<double> result(horizontal_.size());
  double lx = 0;
  for (std::size_t patch = 1; patch < result.size(); ++patch) {
    double sum = 0;
    for (std::size_t i = 0; i < points_a_patch_; ++i) {
      const Vector3d d = points_[(patch - 1) * points_a_patch_ + i];
      sum += relative_luminance(sky, d.z, std::clamp(dot(d, to_sun), -1.0, 1.0));
    }
    result[patch] = sum / static_cast<double>(points_a_patch_);
    lx += result[patch] * horizontal_[patch];
  }
  for (double& luminance : result) luminance *= lx > 0 ? sky.diffuse_lx / lx : 0;
  return result;
}

}  // namespace vitrail
