// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tracer/surfaces/scattering.h"

namespace vitrail {

// It is the direction in which a sample of a BSDF goes.
struct ScatteredDirection {
  Vector3d world;
  bool by_surface = false;  // mirrored about the surface's own normal, whatever the shading normal is
};

// `direction` is that of the sample, and `out` is in the scattering's frame. The shading normal may let the
// sample through the surface, or reflect it into it. A mirror then goes by the surface's own normal, and all
// else ends: the result is empty.
inline std::optional<ScatteredDirection> kept_on_its_side(const Scattering& scattering, const Interaction& at,
                                                          Vector3d out, const BsdfSample& chosen,
                                                          Vector3d direction) {
  if (!leaves_its_side(scattering, at, out, chosen, direction)) return ScatteredDirection{direction, false};
  if (!chosen.specular || !(out.z * chosen.in.z > 0)) return std::nullopt;
  return ScatteredDirection{mirrored(at), true};
}

}  // namespace vitrail
