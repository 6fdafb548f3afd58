// SPDX-License-Identifier: Apache-2.0
// Photons: power on its way from a light, by the same events as a path's, which is importance on its way from
// the camera. Where the two differ is here.
#pragma once

#include "tracer/surfaces/interaction.h"
#include "tracer/surfaces/scattering.h"

namespace vitrail {

// What has happened to a photon since its light, bits of what other paths have as their sample. Neither: it
// went straight, and connections find the same light.
enum PhotonHistory : std::uint32_t {
  photon_refracted = 1,  // by smooth interfaces, or reflected to and fro by parallel faces
  photon_scattered = 2,  // by anything else
  photon_counted = 4,    // of what connections pass, it has met something that counts for its depth
};
// Above them the code of its FaceDoubt, in 4 bits, and the bits of its PhotonWalk.
inline constexpr int photon_doubt_shift = 3, photon_walk_shift = 7;

// Whether what photons bring is looked up there, for all but what a smooth coat mirrors: paths go on with
// that.
inline bool gathers(const Scattering& scattering) {
  return (is_diffuse(scattering.bsdf) || std::holds_alternative<PlasticBsdf>(scattering.bsdf)) &&
         scattering.bump_alpha2 == 0;
}

// A shading normal is not symmetric: importance has the cosines of where it goes, power those of where it
// comes from (Veach 1997, eq. 5.19). Power scattered into `direction` is this times as much. 1 where the
// normal is the surface's; `normal` on either side.
inline float adjoint_of_shading(const Interaction& at, Vector3d normal, Vector3d direction) {
  const double there = dot(direction, normal) * dot(at.out, at.geometric),
               back = dot(at.out, normal) * dot(direction, at.geometric);
  return there == 0 ? 0 : static_cast<float>(std::abs(back / there));
}

}  // namespace vitrail
