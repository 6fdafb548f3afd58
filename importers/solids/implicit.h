// SPDX-License-Identifier: Apache-2.0
// These solids are where a function is negative.
#pragma once

#include <functional>
#include <span>
#include <variant>
#include <vector>

#include "importers/solids/solid.h"

namespace vitrail::solids {

struct ContainingSphere {
  Point3d center;
  double radius = 1;
};
using Container = std::variant<Bounds3d, ContainingSphere>;

// It is negative inside. Any value may come, infinities too; NaN counts as outside. It is called from one
// thread.
using Field = std::function<double(const Point3d&)>;

// It is the set where `field` < 0 within the container, closed by the container's surface.
struct Implicit {
  Field field;
  Container container = Bounds3d{{-1, -1, -1}, {1, 1, 1}};
  bool open = false;        // what the container closes is `unseen`
  double max_gradient = 0;  // a bound of |∇field|: cells that cannot hold a zero are skipped. 0: unknown
  // It returns whether the field is known at once to be positive all over a box. Without it no box is known
  // to be.
  std::function<bool(const Bounds3d&)> is_outside = {};
  int cells = 48;         // along the greatest edge: what is thinner than a cell may be lost
  int most_halvings = 4;  // of a triangle's edges, to come near enough to the zero
};

// Triangles are cut of tetrahedra (Doi and Koide 1991) and then halved until edges are as near to the zero as
// the tessellation asks. The solid is empty where the field has no zero.
Solid implicit(const Implicit& implicit, const Tessellation& tessellation = {});

// Returns the zero of a field that has no container, up to `far` along each axis and open there. Its lattice
// is even up to `near`, and ever coarser beyond: a part that is thinner than .06 of its distance may be lost.
Solid far_reaching(const Field& field, double near, double far, const Tessellation& tessellation = {});

// Takes coefficients as POV-Ray lists them: xⁱyʲzᵏ with i + j + k ≤ order, highest i first, then j, then k;
// of order 2 these are 10 numbers. POV-Ray's `quadric` lists them otherwise: see `quadric_coefficients`.
Field polynomial(int order, std::vector<double> coefficients);

// Turns <A,B,C>,<D,E,F>,<G,H,I>,J into the order of `polynomial`: Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy
// + Iz + J.
std::vector<double> quadric_coefficients(std::span<const double, 10> abc);

// It is a part of a blob: strength · (1 − (d/radius)²)², where d < radius is the distance from a segment, or
// from a point where both ends are equal.
struct BlobComponent {
  Point3d end1, end2;
  double radius = 1, strength = 1;
  Transform to_blob;  // has an inverse
};
struct Blob {
  std::vector<BlobComponent> components;
  double threshold = 1;
};
Solid blob(const Blob& blob, const Tessellation& tessellation = {});

enum class SweepKind { linear, cubic, b_spline };
struct SweptSphere {
  Point3d center;
  double radius = 1;
};
// It is the volume that spheres cover whose centre and radius go along a spline. Cubic ones and B-splines
// take the first and the last for slopes.
struct SphereSweep {
  SweepKind kind = SweepKind::linear;
  std::vector<SweptSphere> spheres;
};
Solid sphere_sweep(const SphereSweep& sweep, const Tessellation& tessellation = {});

}  // namespace vitrail::solids
