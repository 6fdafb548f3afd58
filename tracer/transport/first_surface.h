// SPDX-License-Identifier: Apache-2.0
// What the film keeps of the first surface that a camera ray meets.
#pragma once

#include "tracer/transport/scatterer.h"

namespace vitrail {

// Called where the path has decided that the surface is there, but for a mask of its material, which it will
// decide alike.
void record_first_surface(Tracing& tracing, CameraPath& path, const Event& event);
// Where it is scattered before it has met one.
void record_first_medium(Tracing& tracing, CameraPath& path);
// Where it leaves the scene. What has come there straight from the camera, through holes, sheets and media,
// has covered as much of its pixel as they have taken of it.
void record_leaving(Tracing& tracing, const CameraPath& path);

}  // namespace vitrail
