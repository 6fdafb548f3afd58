// SPDX-License-Identifier: Apache-2.0
#include "tracer/quadrics/placed_quadric.h"

#include <cmath>

namespace vitrail {

PlacedQuadric::PlacedQuadric(const OrientedQuadric& quadric, const Affine& to_bundle) {
  const auto& m = to_bundle.m;
  origin = {m[0][3], m[1][3], m[2][3]};
  for (int j = 0; j < 3; ++j) column[j] = {m[0][j], m[1][j], m[2][j]};
  for (int j = 0; j < 3; ++j) cofactor[j] = cross(column[(j + 1) % 3], column[(j + 2) % 3]);
  const double signed_determinant = dot(column[0], cofactor[0]);
  determinant = std::abs(signed_determinant);
  scale = 1 / signed_determinant;
  for (int j = 0; j < 3; ++j) inverse[j] = cofactor[j] * scale;
  double norm2 = 0;
  for (const Vector3d& row : inverse) norm2 += dot(row, row);
  doubt = 0x1p-48 * (1 + std::sqrt(norm2 * dot(origin, origin)));
  is_turned = mirrors(to_bundle) != quadric.inside_out;
}

}  // namespace vitrail
