// SPDX-License-Identifier: Apache-2.0
// A quadric that emits, cut into patches alike in area in its own space, of which a tree chooses by what each
// can send to a point: those that are near, and turned to it.
#pragma once

#include <array>
#include <optional>

#include "bundle/manifest.h"
#include "tracer/lights/light_tree.h"

namespace vitrail {

// Of a surface's sides, the inner one around its axis, which of all that is visible from a point.
enum class Sides : std::uint8_t { both, outer, inner };
// With the discs in its openings, what goes all the way round is the edge of a convex body: from between the
// planes of these one side alone is seen, whatever else is there. `own_from` in the quadric's own space.
Sides sides_seen(const Quadric& quadric, Point3d own_from);

class QuadricPatches {
 public:
  static constexpr int most = 256;
  static constexpr int fewest = 8;
  // About `count` of them, a power of two within these.
  QuadricPatches(const EmissiveQuadric& record, bool two_sided, int count);

  struct Place {
    double s = 0, t = 0;  // by area (quadric_area.h)
    double density = 0;   // there, of the unit square of (s,t)
  };
  // u, v in [0,1). Empty where nothing that emits is seen.
  std::optional<Place> choose(Point3d from, Sides seen, double u, double v) const;
  // Of Place, of a point of it in its own space.
  double density(Point3d from, Sides seen, Point3d local) const;

 private:
  const LightTree& tree(Sides seen) const { return trees_[two_sided_ ? static_cast<std::size_t>(seen) : 0]; }

  Quadric quadric_;
  bool two_sided_ = false;
  int columns_ = 1, rows_ = 1;      // along s, t
  std::array<LightTree, 3> trees_;  // by Sides, of what shines on two sides; else the first alone
};

}  // namespace vitrail
