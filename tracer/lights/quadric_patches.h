// SPDX-License-Identifier: Apache-2.0
// A quadric that emits is cut into patches alike in area in its own space. A tree chooses among them by what
// each can send to a point: those that are near, and turned to it.
#pragma once

#include <array>
#include <optional>

#include "bundle/manifest.h"
#include "tracer/lights/light_tree.h"

namespace vitrail {

// It says which of a surface's sides are visible from a point: both, the outer one, or the inner one around
// its axis.
enum class Sides : std::uint8_t { both, outer, inner };
// Returns the sides that are seen from `own_from`, in the quadric's own space. A quadric that goes all the
// way round is, with the discs in its openings, the edge of a convex body. Between the planes of these discs
// one side alone is seen.
Sides sides_seen(const Quadric& quadric, Point3d own_from);

class QuadricPatches {
 public:
  static constexpr int most = 256;
  static constexpr int fewest = 8;
  // Makes about `count` patches: a power of two from `fewest` to `most`.
  QuadricPatches(const EmissiveQuadric& record, bool two_sided, int count);

  struct Place {
    double s = 0, t = 0;  // by area (quadric_area.h)
    double density = 0;   // there, of the unit square of (s,t)
  };
  // u and v are in [0,1). It returns nothing where nothing that emits is seen.
  std::optional<Place> choose(Point3d from, Sides seen, double u, double v) const;
  // Returns Place::density at a point of the quadric in its own space.
  double density(Point3d from, Sides seen, Point3d local) const;

 private:
  const LightTree& tree(Sides seen) const { return trees_[two_sided_ ? static_cast<std::size_t>(seen) : 0]; }

  Quadric quadric_;
  bool two_sided_ = false;
  int columns_ = 1, rows_ = 1;      // along s, t
  std::array<LightTree, 3> trees_;  // by Sides, of what shines on two sides; else the first alone
};

}  // namespace vitrail
