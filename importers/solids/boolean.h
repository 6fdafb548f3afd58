// SPDX-License-Identifier: Apache-2.0
// These functions do one operation on two meshes, by CGAL's corefinement.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "importers/solids/solid.h"

namespace vitrail::solids {

enum class Operation { unite, intersect, subtract };

// It has either a solid, or why there is none. Triangles keep the surface of the operand that they came from,
// and its normals. `moved`: the second operand was shifted and scaled by that fraction of its size.
struct BooleanResult {
  std::optional<Solid> solid;
  std::string reason;
  double moved = 0;
};

// Takes two closed solids, neither of which intersects itself where they meet.
BooleanResult boolean(Operation operation, const Solid& a, const Solid& b);

// Returns what `others` leave of a closed solid, one after the other, with exact coordinates in between: a
// cut that was rounded may intersect itself, and then the next cannot be made. It is slower.
BooleanResult subtract_exactly(const Solid& a, std::span<const Solid> others);

// Returns the part of a surface, closed or not, that is inside a closed solid, or outside.
BooleanResult cut_surface(const Solid& surface, const Solid& by, bool keep_inside);

}  // namespace vitrail::solids
