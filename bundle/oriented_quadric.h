// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shapes/quadric.h"

namespace vitrail {

// An OrientedQuadric is an object that is no mesh. Its front stays its front under transforms that mirror.
struct OrientedQuadric {
  Quadric quadric;
  bool inside_out = false;  // the front is inside, of a disk −z
  bool operator==(const OrientedQuadric&) const = default;
};

}  // namespace vitrail
