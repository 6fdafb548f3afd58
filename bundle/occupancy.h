// SPDX-License-Identifier: Apache-2.0
// Which parts of a domain's box hold anything: 8×8×8 cells, so that a ray that would only pass through empty
// space neither loads the domain nor is sent to it.
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

// Marks the cells of `box` that lie within `padding` of a convex polygon. Conservative: it may mark more.
void mark(Occupancy& occupancy, const Bounds3f& box, std::span<const Point3d> polygon, double padding);
// Marks all cells that `content` reaches, which is padded already.
void mark(Occupancy& occupancy, const Bounds3f& box, const Bounds3f& content);

// Of what a domain holds: its pieces, in the order of a PieceList, and the triangles it has whole, padded and
// with that margin; and its instances' boxes.
Occupancy occupancy_of(const Bounds3f& box, const DomainView& view, std::span<const Piece> pieces,
                       std::span<const Point3d> piece_vertices, double margin);

// Whether p + t·d, t0 ≤ t ≤ t1, meets a marked cell of the box. What rounding of the ray's way through the
// cells may miss has to lie within the margin of the marks: they are a 10⁻¹⁴ of the coordinates.
bool meets(const Occupancy& occupancy, const Bounds3f& box, Point3d p, Vector3d d, double t0, double t1);

}  // namespace vitrail
