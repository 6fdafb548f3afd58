// SPDX-License-Identifier: Apache-2.0
// These functions record what the film keeps of the first surface that a camera ray meets.
#pragma once

#include "tracer/transport/scatterer.h"

namespace vitrail {

// It is called where the path has decided that the surface is there. A mask of its material is still open,
// which the path will decide alike.
void record_first_surface(Tracing& tracing, CameraPath& path, const Event& event);
// Records a path that is scattered before it has met a surface.
void record_first_medium(Tracing& tracing, CameraPath& path);
// Records a path that leaves the scene. It may have passed holes, sheets and media straight from the camera:
// these have covered as much of its pixel as they have taken of it.
void record_leaving(Tracing& tracing, const CameraPath& path);

}  // namespace vitrail
