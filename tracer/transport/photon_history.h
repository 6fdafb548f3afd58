// SPDX-License-Identifier: Apache-2.0
// These functions keep what has happened to a photon as connections to its light would have it. Light that
// connections find is not gathered as well.
#pragma once

#include <cmath>

#include "tracer/transport/scatterer.h"

namespace vitrail {

// Returns where a photon begins, and its power and direction then.
EmittedPhoton emission_of(const Tracing& tracing, const PhotonPath& photon);

// Returns whether paths find the photon's light by a connection to it, or by a sample of a BSDF that sees it.
// They find light that came straight, and that of a distant light behind panes, which goes on as it came.
bool is_connected_to(const Tracing& tracing, const PhotonPath& photon);

// Passes the photon straight through a sheet or a parallel face.
void pass_sheet(PhotonPath& photon);
// Refracts the photon into `direction`, which becomes that of a connection through the face.
void pass_interface(const Tracing& tracing, PhotonPath& photon, const Event& event, const MetFace& face,
                    Vector3d& direction);
// Reflects the photon into `direction`. It goes as connections do where the face is parallel to those that
// the photon has passed, else it has scattered.
void turn_at_face(const Tracing& tracing, PhotonPath& photon, const Event& event, const MetFace& face,
                  Vector3d& direction);

// A shading normal is not symmetric: importance has the cosines of where it goes, power those of where it
// comes from (Veach 1997, eq. 5.19). Returns the factor for power that is scattered into `direction`. It is 1
// where the normal is the surface's; `normal` may be on either side.
inline float adjoint_of_shading(const Interaction& at, Vector3d normal, Vector3d direction) {
  const double there = dot(direction, normal) * dot(at.out, at.geometric),
               back = dot(at.out, normal) * dot(direction, at.geometric);
  return there == 0 ? 0 : static_cast<float>(std::abs(back / there));
}

}  // namespace vitrail
