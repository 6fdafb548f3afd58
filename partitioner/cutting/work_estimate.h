// SPDX-License-Identifier: Apache-2.0
// A WorkEstimate is how much work triangles are: the same each, or by the rays of an earlier render.
#pragma once

#include <optional>
#include <vector>

#include "bundle/ray_profile.h"
#include "partitioner/cutting/choose_plane.h"

namespace vitrail {

class WorkEstimate {
 public:
  WorkEstimate() = default;
  // `offset` is that of the scene to be cut. Half of a triangle's work is its own, half its share of the rays
  // that were traced in its domain; eight times the mean at most. So domains that rays hardly see have at
  // most twice the mean's triangles, and those that all see get smaller.
  WorkEstimate(RayProfile profile, Vector3d offset);

  std::vector<Item> items(const std::vector<Bounds3f>& boxes) const;

 private:
  std::optional<RayProfile> profile_;
  Vector3d offset_;
  std::vector<float> work_;  // of an item in each of the profile's domains
};

}  // namespace vitrail
