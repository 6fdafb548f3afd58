// SPDX-License-Identifier: Apache-2.0
// Casts to float round, whatever the optimiser makes of them.
#include <gtest/gtest.h>

#include "scene/geometry/bounds.h"

namespace vitrail::rounding_test {
namespace {

// As importers move meshes that lie far from the origin.
__attribute__((noinline)) Vector3d rounded_center(const Bounds3d& bounds) {
  if (bounds.empty()) return {};
  const Vector3d away = center(bounds) - Point3d{}, half = extent(bounds) * 0.5;
  const bool is_far = length(away) > 16 * length(half) && length(half) > 0;
  return is_far ? cast<double>(cast<float>(away)) : Vector3d{};
}

TEST(Rounding, OfDoublesToFloatsIsNotOptimisedAway) {
  Bounds3d bounds;
  extend(bounds, Point3d{5000000.001, 0, .125});
  extend(bounds, Point3d{5000000.002, 0.0017, 0});
  const Vector3d offset = rounded_center(bounds);
  EXPECT_EQ(offset.x, 5000000.0);
  EXPECT_EQ(offset.y, static_cast<double>(0.00085f));
}

}  // namespace
}  // namespace vitrail::rounding_test
