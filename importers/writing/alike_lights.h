// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/records/light.h"

namespace vitrail {

// Returns whether only names and places tell the lights apart: where formats have the light in the material,
// one does for both.
inline bool shine_alike(AreaLight a, const AreaLight& b) {
  a.name = b.name;
  a.origin = b.origin;
  return a == b;
}

}  // namespace vitrail
