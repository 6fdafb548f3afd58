// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace vitrail {

// A triangle is divided into side² alike ones. They stand row by row along b₁. A row has in turn along b₂
// those that stand as the triangle does and those between them. Points are sampled by how much the parts
// shine.
class TriangleParts {
 public:
  struct Shine {
    double mean = 0, most = 0;  // 0 as `most`: certainly nothing
  };
  // Returns nothing where parts are not worth it: no part has many times the mean.
  static std::optional<TriangleParts> of(std::span<const Shine> parts);

  struct Place {
    double b1 = 0, b2 = 0;
    double density = 1;  // of uniform points
  };
  // All numbers are in [0,1).
  Place choose(double choice, float u, float v) const;
  // Returns Place::density at a point.
  double density(double b1, double b2) const;

 private:
  double share(std::size_t part) const { return cumulative_[part + 1] - cumulative_[part]; }
  int side_ = 1;
  std::vector<double> cumulative_;  // 0 … 1
};

// Returns a uniform place on a triangle (Heitz 2019), by a low-distortion map of the square.
TriangleParts::Place uniform_place(float u, float v);

}  // namespace vitrail
