// SPDX-License-Identifier: Apache-2.0
// These are affine and projective 4×4 transforms in double precision. Importers compose them here and round
// only at the end.
#pragma once

#include <array>

#include "scene/geometry/vec.h"

namespace vitrail {

// Vectors are columns: p' = M p, m[row][column], translation in the last column.
struct Transform {
  std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  bool operator==(const Transform&) const = default;
};

// Returns the transform that does b first, then a.
Transform operator*(const Transform& a, const Transform& b);

// They translate by these distances, or scale by these factors.
Transform translate(Vector3d by);
Transform scale(Vector3d by);
// Returns the right-handed rotation by `angle_rad` about `axis` (any length; zero gives the identity).
Transform rotate(double angle_rad, Vector3d axis);
// Returns camera-to-world of a camera at `eye` looking at `target`: +z is the view direction, +y is up and +x
// is pbrt's raster right, up × view. A degenerate frame (eye = target, up parallel to the view) gives nothing
// finite to return: the caller checks with `is_invertible`.
Transform look_at(Point3d eye, Point3d target, Vector3d up);

// Returns the inverse by cofactors; `is_invertible` says beforehand whether it exists.
Transform inverse(const Transform& t);
bool is_invertible(const Transform& t);

// Divides by w where w ≠ 1.
Point3d transform_point(const Transform& t, Point3d p);
Vector3d transform_vector(const Transform& t, Vector3d v);
// Transforms by the inverse transpose of the upper 3×3 block, up to scale: uses cofactors, so it is defined
// even for singular transforms. The sign follows det > 0; for mirrors the normal keeps its side. It is not
// normalised.
Normal3d transform_normal(const Transform& t, Normal3d n);

// Returns the transform rounded to 40 bits below the greatest entry, for the 3×3 block and for the
// translation. This removes the noise that inverting a matrix leaves. Then a camera is the same whether a
// file gives its matrix or the inverse.
Transform snapped(const Transform& t);

// Returns the determinant of the upper 3×3 block.
double determinant3(const Transform& t);
// Returns whether the transform mirrors: the handedness of the upper 3×3 block changes.
bool swaps_handedness(const Transform& t);

}  // namespace vitrail
