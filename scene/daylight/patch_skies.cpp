// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/patch_skies.h"

#include <algorithm>
#include <cmath>

#include "scene/daylight/sky_distribution.h"

namespace vitrail {

namespace {

// What of a sky goes with the angle γ from the sun, as a table over sin(γ/2): a year has 10⁷ points of skies.
// It is off by less than 10⁻³ of its value.
class AroundTheSun {
 public:
  explicit AroundTheSun(const SkyDistribution& sky) {
    for (int i = 0; i <= segments; ++i) {
      const double t = static_cast<double>(i) / segments;
      values_.push_back(scattering_of(sky, 1 - 2 * t * t));
    }
  }
  double at(double cosine) const {
    const double place = std::sqrt(std::max(0.0, (1 - cosine) / 2)) * segments;
    const std::size_t low = std::min(static_cast<std::size_t>(place), std::size_t{segments - 1});
    const double part = place - static_cast<double>(low);
    return values_[low] + (values_[low + 1] - values_[low]) * part;
  }

 private:
  static constexpr int segments = 512;
  std::vector<double> values_;
};

}  // namespace

PatchSkies::PatchSkies(const SkyPatches& patches) : horizontal_(patches.count()) {
  // About as close to each other whatever the patches are.
  const int side = std::max(2, 8 / patches.mf());
  points_a_patch_ = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  for (std::size_t patch = 1; patch < patches.count(); ++patch) {
    double height = 0;
    for (int i = 0; i < side * side; ++i) {
      const int column = i % side, row = i / side;
      const Vector3d d = patches.direction(patch, (column + 0.5) / side, (row + 0.5) / side);
      const auto known = std::ranges::find(heights_, d.z);
      points_.push_back({d, static_cast<std::size_t>(known - heights_.begin())});
      if (known == heights_.end()) heights_.push_back(d.z);
      height += d.z;
    }
    horizontal_[patch] = patches.solid_angle(patch) * height / static_cast<double>(points_a_patch_);
  }
}

std::vector<double> PatchSkies::luminances(const SkyDistribution& sky, Vector3d to_sun) const {
  const AroundTheSun scattering(sky);
  std::vector<double> gradients;
  for (const double z : heights_) gradients.push_back(gradient_of(sky, z));
  std::vector<double> result(horizontal_.size());
  double lx = 0;
  for (std::size_t patch = 1; patch < result.size(); ++patch) {
    double sum = 0;
    for (std::size_t i = 0; i < points_a_patch_; ++i) {
      const Point& point = points_[(patch - 1) * points_a_patch_ + i];
      sum += std::max(0.0, gradients[point.height] * scattering.at(dot(point.direction, to_sun)));
    }
    result[patch] = sum / static_cast<double>(points_a_patch_);
    lx += result[patch] * horizontal_[patch];
  }
  for (double& luminance : result) luminance *= lx > 0 ? sky.diffuse_lx / lx : 0;
  return result;
}

}  // namespace vitrail
