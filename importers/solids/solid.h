// SPDX-License-Identifier: Apache-2.0
// A Solid has triangles that enclose a volume. All shapes of this folder are made as such.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/geometry/bounds.h"
#include "scene/geometry/transform.h"
#include "scene/shapes/mesh.h"

namespace vitrail::solids {

// It says how near triangles are to the shape's true surface, as a fraction of the greatest edge of its
// bounding box.
struct Tessellation {
  double deviation = 5e-4;
};

// It is the number of a surface whose triangles close a solid but are not to be seen: the caps of an open
// cylinder, the sides of a cube that stands for infinity. `mesh_of` leaves them out.
inline constexpr std::uint32_t unseen = 0xffffffff;

// Vertices are shared by place alone: each edge of a closed solid has two triangles that run along it in
// opposite directions, counter-clockwise seen from outside (cross products of right-handed axes). Normals are
// those of the true surface, a unit vector a corner of a triangle, and point outwards.
struct Solid {
  std::vector<Point3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<Normal3f, 3>> normals;  // as many as triangles
  std::vector<std::uint32_t> surfaces;  // as many as triangles: a number that the caller gives, or `unseen`
  bool closed = true;

  bool empty() const { return triangles.empty(); }
};

// They return all triangles of the surfaces that are seen, or of one of them. Corners share a vertex where
// place and normal are equal. They throw Error where a position is not finite in single precision.
TriangleMesh mesh_of(const Solid& solid);
TriangleMesh mesh_of(const Solid& solid, std::uint32_t surface);

// Returns the numbers of the surfaces that are seen, in ascending order.
std::vector<std::uint32_t> surfaces_of(const Solid& solid);

// Gives a number to all surfaces that are seen.
void set_surface(Solid& solid, std::uint32_t surface);

// Keeps fronts outside under mirrors. Throws Error for a transform without an inverse.
Solid transformed(Solid solid, const Transform& to);

// Returns the complement: fronts and normals are turned round.
Solid inverted(Solid solid);

// Appends `other` as further bodies of one solid, which may overlap.
void append(Solid& solid, const Solid& other);

Bounds3d bounds_of(const Solid& solid);
// Returns whether neither is empty, and they have a point in common.
bool boxes_meet(const Bounds3d& a, const Bounds3d& b);

// Returns the normal at a point in a triangle: that of a corner, bit for bit, where the point is one, so that
// neighbours go on sharing it.
Normal3f normal_at(const Solid& solid, std::size_t triangle, Point3d p);

// Returns the sum of the volumes of its bodies, positive where fronts are outside.
double volume(const Solid& solid);

// Returns whether each edge has two triangles, in opposite directions.
bool is_watertight(const Solid& solid);

}  // namespace vitrail::solids
