// SPDX-License-Identifier: Apache-2.0
// This file begins paths that measure at sensors. A sensor is a white diffuse surface: radiance leaves it,
// the irradiance over π. The medium that the file gives is the camera's. Where surfaces divide space, a
// sensor's own medium is found first, by a ray along its normal. A surface that the sensor lies in does not
// hide this ray.
#pragma once

#include "tracer/transport/find_hit.h"
#include "tracer/transport/scatterer.h"
#include "tracer/transport/shadow_ray.h"

namespace vitrail {

enum class Begun { goes_on, ends, elsewhere };

// Begins a path at a sensor. The path has begun at the camera, in the sensor's column.
Begun begin_at(Tracing& tracing, CameraPath& path, const Sensor& sensor, ShadowRays& shadows);
// Begins the path of a probe that came to `at` before the sensor's surroundings were known.
Begun resume(Tracing& tracing, const ProbeRecord& record, const Arrival& at, CameraPath& path,
             ShadowRays& shadows);

}  // namespace vitrail
