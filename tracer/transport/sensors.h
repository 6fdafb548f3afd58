// SPDX-License-Identifier: Apache-2.0
// Sensors: where paths begin that measure. A sensor is a white diffuse surface at which paths begin: radiance
// leaves it, the irradiance over π. The medium that the file gives is the camera's: where surfaces divide
// space, a sensor's own is found first, by a ray along its normal, which no surface hides that it lies in.
#pragma once

#include "tracer/transport/find_hit.h"
#include "tracer/transport/scatterer.h"
#include "tracer/transport/shadow_ray.h"

namespace vitrail {

enum class Begun { goes_on, ends, elsewhere };

// A path that has begun at the camera, in a column that is a sensor's, begins there.
Begun begin_at(Tracing& tracing, CameraPath& path, const Sensor& sensor, ShadowRays& shadows);
// The path of one that came to `at` before its place was known.
Begun resume(Tracing& tracing, const ProbeRecord& record, const Arrival& at, CameraPath& path,
             ShadowRays& shadows);

}  // namespace vitrail
