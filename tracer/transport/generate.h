// SPDX-License-Identifier: Apache-2.0
// Paths where they begin: at the camera, and where they come from another domain.
#pragma once

#include "tracer/transport/find_hit.h"
#include "tracer/transport/scatterer.h"

namespace vitrail {

// Of a path's sample through the pixel (x, y) of the whole film.
CameraRay camera_ray(const Tracing& tracing, const CameraPath& path, int x, int y);
// Sample `sample` of the pixel (x, y) of the whole film, which lies in the crop. False where it is dark: the
// lens holds it up.
bool begin(Tracing& tracing, CameraPath& path, int x, int y, std::uint32_t sample);

void pack(const Tracing& tracing, const CameraPath& path, bool resolved, RayRecord& record);
void unpack(const Tracing& tracing, const PathRecord& record, CameraPath& path);

}  // namespace vitrail
