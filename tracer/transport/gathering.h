// SPDX-License-Identifier: Apache-2.0
// What photons bring to a point where a path scatters: asked for there, answered where the map of it is.
#pragma once

#include "tracer/transport/scatterer.h"

namespace vitrail {

// Whether what photons bring is looked up there, for all but what a smooth coat mirrors: paths go on with
// that.
inline bool gathers(const Scattering& scattering) {
  return (is_diffuse(scattering.bsdf) || std::holds_alternative<PlasticBsdf>(scattering.bsdf)) &&
         scattering.bump_alpha2 == 0;
}
void gather(Tracing& tracing, const CameraPath& path, const Interaction& at, const Scattering& scattering,
            Vector3d out);
// The same at a sensor where a path begins.
void gather_at_sensor(Tracing& tracing, const CameraPath& path, const Sensor& sensor);
// What the map has for a path, wherever that ended.
void answer(Tracing& tracing, const Gather& question);

}  // namespace vitrail
