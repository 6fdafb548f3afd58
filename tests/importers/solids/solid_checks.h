// SPDX-License-Identifier: Apache-2.0
// What every closed solid has to be.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "importers/solids/solid.h"

namespace vitrail::solids {

// Closed, oriented outwards, with unit normals that lean to their triangle's front by `least_cosine` at
// least.
inline void expect_sound(const Solid& solid, double least_cosine) {
  ASSERT_EQ(solid.normals.size(), solid.triangles.size());
  ASSERT_EQ(solid.surfaces.size(), solid.triangles.size());
  ASSERT_FALSE(solid.empty());
  EXPECT_TRUE(is_watertight(solid));
  EXPECT_GT(volume(solid), 0);
  const Vector3d size = extent(bounds_of(solid));
  const double tiny = 1e-9 * dot(size, size);
  double least = 1;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const auto p = [&](std::size_t i) { return solid.positions[solid.triangles[t][i]]; };
    const Vector3d area = cross(p(1) - p(0), p(2) - p(0));
    for (const Normal3f& n : solid.normals[t]) {
      EXPECT_NEAR(length(to_vector(cast<double>(n))), 1, 1e-5);
      if (length(area) > tiny) least = std::min(least, dot(normalize(area), to_vector(cast<double>(n))));
    }
  }
  EXPECT_GT(least, least_cosine);
}

// The greatest |distance(p)| of corners, middles of edges and middles of triangles that are seen.
template <class Distance>
double greatest_distance(const Solid& solid, Distance&& distance) {
  double greatest = 0;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    if (solid.surfaces[t] == unseen) continue;
    const auto p = [&](std::size_t i) { return solid.positions[solid.triangles[t][i % 3]]; };
    greatest =
        std::max(greatest, std::abs(distance(p(0) + (p(1) - p(0)) * (1.0 / 3) + (p(2) - p(0)) * (1.0 / 3))));
    for (std::size_t i = 0; i < 3; ++i) {
      greatest = std::max(greatest, std::abs(distance(p(i))));
      greatest = std::max(greatest, std::abs(distance(p(i) + (p(i + 1) - p(i)) * 0.5)));
    }
  }
  return greatest;
}

inline double greatest_edge(const Solid& solid) {
  const Vector3d size = extent(bounds_of(solid));
  return std::max({size.x, size.y, size.z});
}

}  // namespace vitrail::solids
