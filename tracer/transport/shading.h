// SPDX-License-Identifier: Apache-2.0
// These functions handle a path from the camera where it arrives: in a medium, at a surface, outside of the
// scene. Radiance that it meets is deposited, and connections to lights are made (next-event estimation with
// multiple importance sampling, Veach 1997). It goes on by a sample of what scatters there.
#pragma once

#include "tracer/transport/scatterer.h"
#include "tracer/transport/shadow_ray.h"

namespace vitrail {

// It says where a path has come to after its flight: what it meets, or a point of the medium that it flew
// through.
struct Arrived {
  const PreparedMedium* scatters_in = nullptr;
  Point3d p;  // there
  bool has_flown = false;
};
// Lets a path fly through the medium that it is in, if it is in one. Returns nothing when the path ends
// there.
std::optional<Arrived> fly(Tracing& tracing, CameraPath& path);
// Returns false when the path ends here. Shadow rays that it takes are put behind the others of `shadows`.
bool shade(Tracing& tracing, CameraPath& path, const Arrived& arrived, ShadowRays& shadows);
// Returns whether lamps and surroundings are hidden from a path, since it comes from the camera directly.
bool is_hidden(const Tracing& tracing, const CameraPath& path);
// Returns, with direct light alone, whether a path comes from its last mirror or glass. There no surface is
// lit, so nothing glows either, as at POV-Ray's max_trace_level.
bool is_past_last_level(const Tracing& tracing, const CameraPath& path);
// Returns, with direct light alone, whether every wavelength of a path carries less than the film's
// threshold.
bool is_too_dark(const Tracing& tracing, const CameraPath& path);
// Returns whether a path ends where connections to lights are made. With direct light alone it could only
// find lamps by itself, and there are none to be found.
bool ends_lit(const Tracing& tracing);
// Adds the light of a surface that emits, where a path has come to it.
void add_emission(Tracing& tracing, const CameraPath& path, const Interaction& at, std::uint32_t area_light);

}  // namespace vitrail
