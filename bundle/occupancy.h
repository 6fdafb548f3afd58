// SPDX-License-Identifier: Apache-2.0
// An Occupancy says which of 8×8×8 parts of a domain's box hold anything. A ray that would only pass through
// empty space neither loads the domain nor is sent to it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bundle/domain_file.h"
#include "scene/geometry/bounds.h"

namespace vitrail {

struct Occupancy {
  static constexpr int cells = 8;            // on each axis
  std::array<std::uint64_t, cells> slice{};  // slice[z], bit y·8 + x
  bool operator==(const Occupancy&) const = default;
};

// Marks the cells of `box` that lie within `padding` of a convex polygon. It is conservative: it may mark
// more.
void mark(Occupancy& occupancy, const Bounds3f& box, std::span<const Point3d> polygon, double padding);
// Marks all cells that `content` reaches, which is padded already.
void mark(Occupancy& occupancy, const Bounds3f& box, const Bounds3f& content);

// Returns the cells that hold what is in a domain: its pieces, in the order of a PieceList, its whole
// triangles and its instances' boxes. Pieces and triangles are padded, and by the margin more.
Occupancy occupancy_of(const Bounds3f& box, const DomainView& view, std::span<const Piece> pieces,
                       std::span<const Point3d> piece_vertices, double margin);

// Returns whether p + t·d, t0 ≤ t ≤ t1, meets a marked cell of the box. Rounding of the ray's way through the
// cells, 10⁻¹⁴ of the coordinates, has to lie within the margin of the marks.
bool meets(const Occupancy& occupancy, const Bounds3f& box, Point3d p, Vector3d d, double t0, double t1);

}  // namespace vitrail
