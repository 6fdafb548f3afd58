// SPDX-License-Identifier: Apache-2.0
// This file has smooth glass: what a path or a photon does at its faces. It also decides what panes, whose
// faces are parallel, let through as it came.
#pragma once

#include "tracer/transport/scatterer.h"

namespace vitrail {

// Depth counts scatterings, each face of glass among them. Panes that light passes between the last
// scattering and its light do not count, as they do not for connections to the sun. A path that is spent goes
// on through them, by what they transmit, and so does a photon that has met nothing else yet.
bool sees_through(const Tracing& tracing, const CameraPath& path, const Interaction& at);
bool sees_through(const Tracing& tracing, const PhotonPath& photon, const Interaction& at);

// They scatter at a surface of a smooth dielectric. They return false where the path or photon ends.
bool scatter_dielectric(const Tracing& tracing, CameraPath& path, const Event& event);
bool scatter_dielectric(const Tracing& tracing, PhotonPath& photon, const Event& event);

}  // namespace vitrail
