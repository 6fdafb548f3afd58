// SPDX-License-Identifier: Apache-2.0
// One operation on two meshes, by CGAL's corefinement.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "importers/solids/solid.h"

namespace vitrail::solids {

enum class Operation { unite, intersect, subtract };

// Triangles keep the surface of the operand that they came from, and its normals. Either a solid, or why
// there is none; `moved`: the second operand was shifted and scaled by that fraction of its size.
struct BooleanResult {
  std::optional<Solid> solid;
  std::string reason;
  double moved = 0;
};

// Of two closed solids, neither of which intersects itself where they meet.
BooleanResult boolean(Operation operation, const Solid& a, const Solid& b);

// Returns what `others` leave of a closed solid, one after the other, with exact coordinates in between: a
// cut that was rounded may intersect itself, and then the next cannot be made. It is slower.
BooleanResult subtract_exactly(const Solid& a, std::span<const Solid> others);

// What of a surface, closed or not, is inside a closed solid, or outside.
BooleanResult cut_surface(const Solid& surface, const Solid& by, bool keep_inside);

}  // namespace vitrail::solids
