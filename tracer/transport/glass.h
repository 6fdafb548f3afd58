// SPDX-License-Identifier: Apache-2.0
// Smooth glass: what a path or a photon does at its faces, and what panes, whose faces are parallel, let
// through as it came.
#pragma once

#include "tracer/transport/scatterer.h"

namespace vitrail {

// Depth counts scatterings, each face of glass among them. What passes panes on its way between the last
// scattering and its light is not counted, as connections to the sun are not: a path that is spent goes on
// through them, by what they transmit, and so does a photon that has met nothing else yet.
bool sees_through(const Tracing& tracing, const CameraPath& path, const Interaction& at);
bool sees_through(const Tracing& tracing, const PhotonPath& photon, const Interaction& at);

// At a surface of a smooth dielectric. False when it ends here.
bool scatter_dielectric(const Tracing& tracing, CameraPath& path, const Event& event);
bool scatter_dielectric(const Tracing& tracing, PhotonPath& photon, const Event& event);

}  // namespace vitrail
