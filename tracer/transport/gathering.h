// SPDX-License-Identifier: Apache-2.0
// These functions gather what photons bring to a point where a path scatters. The path asks for it there, and
// the rank with the map of that place answers.
#pragma once

#include "tracer/transport/scatterer.h"

namespace vitrail {

// Returns whether photons are looked up there, for all but what a smooth coat mirrors: paths go on with that.
inline bool gathers(const Scattering& scattering) {
  return (is_diffuse(scattering.bsdf) || std::holds_alternative<PlasticBsdf>(scattering.bsdf)) &&
         scattering.bump_alpha2 == 0;
}
void gather(Tracing& tracing, const CameraPath& path, const Interaction& at, const Scattering& scattering,
            Vector3d out);
// Does the same at a sensor where a path begins.
void gather_at_sensor(Tracing& tracing, const CameraPath& path, const Sensor& sensor);
// Answers a question from the map, wherever its path ended.
void answer(Tracing& tracing, const Gather& question);

}  // namespace vitrail
