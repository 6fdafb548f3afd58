// SPDX-License-Identifier: Apache-2.0
// These functions connect a path to lights: they choose the light, and make the ray to it.
#pragma once

#include "tracer/transport/scatterer.h"
#include "tracer/transport/shadow_ray.h"

namespace vitrail {

// Returns how many candidates for a light a path has at a point. There are several where the camera sees it,
// directly or through mirrors and glass, and where they differ.
std::uint32_t light_candidates(const Tracing& tracing, const CameraPath& path, Point3d p, bool diffuse);

// They connect to one of `candidates` for a light, chosen by what each would bring if nothing was in its way.
// It brings their mean (resampling: Talbot, Cline & Egbert 2005). Weights of multiple importance sampling
// count so many samples of the lights and one of the BSDF. A shadow ray, or a connection where light passes
// something, is put behind the others of `shadows`.
void connect_surface(Tracing& tracing, const CameraPath& path, const Event& event,
                     const Scattering& scattering, Vector3d out, std::uint32_t candidates,
                     ShadowRays& shadows);
void connect_medium(Tracing& tracing, const CameraPath& path, const Departure& from, double g, Vector3d out,
                    std::uint32_t candidates, ShadowRays& shadows);
void connect_sensor(Tracing& tracing, const CameraPath& path, const Departure& from, Vector3d normal,
                    std::uint32_t candidates, ShadowRays& shadows);

// Sends a ray to a light that is chosen, with the radiance that it is to bring.
void send(Tracing& tracing, const CameraPath& path, const Departure& from, const LightSample& light,
          const SampledSpectrum& radiance, ShadowRays& shadows);

}  // namespace vitrail
