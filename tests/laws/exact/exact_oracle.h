// SPDX-License-Identifier: Apache-2.0
// What a ray hits, by CGAL's exact predicates and rational numbers: nothing of it is shared with the tracer.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tests/partitioner/hierarchy/clustered_mesh.h"

namespace vitrail::test {

// Where the ray meets the plane of a triangle; exact but for the last rounding.
struct ExactCrossing {
  std::uint32_t triangle = no_triangle;
  double t = 0;
  double inside = 0;  // least of the three barycentrics: ≥ 0 within the triangle
  double sine = 0;    // of the angle between ray and plane
};

class ExactOracle {
 public:
  explicit ExactOracle(const Triangles& triangles);
  ~ExactOracle();

  // Every triangle that the ray meets in one point. Empty (no answer) where origin + direction is no double,
  // as CGAL takes a ray by two points.
  std::optional<std::vector<ExactCrossing>> crossings(const Ray& ray) const;
  // Nothing where the triangle has no area or the ray is parallel to its plane.
  std::optional<ExactCrossing> crossing(const Ray& ray, std::uint32_t triangle) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vitrail::test
