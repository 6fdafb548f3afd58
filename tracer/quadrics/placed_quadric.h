// SPDX-License-Identifier: Apache-2.0
// A PlacedQuadric says where a quadric stands, and holds what follows from that alone: each value as it would
// be computed anew.
#pragma once

#include "bundle/instance.h"
#include "bundle/oriented_quadric.h"

namespace vitrail {

struct PlacedQuadric {
  PlacedQuadric(const OrientedQuadric& quadric, const Affine& to_bundle);

  Vector3d origin;         // where that of its own space stands, from the bundle's
  Vector3d column[3];      // of the transform's 3×3 block
  Vector3d cofactor[3];    // column 1 × column 2 …
  Vector3d inverse[3];     // rows
  double determinant = 0;  // magnitude; 0: there is no inverse
  double doubt = 0;        // of |q|², where q is on its surface, in its own space
  double scale = 0;        // 1 / determinant, with its sign
  bool is_turned = false;  // its front is not what lies outwards, where the cofactors turn it to
};

}  // namespace vitrail
