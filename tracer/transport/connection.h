// SPDX-License-Identifier: Apache-2.0
// A Connection is a ray to a light, in a scene that has something that light passes. It goes on behind what
// lets it through, and deposits what it carries where its light is. It goes straight on, or, to a distant
// light, through panes: smooth interfaces refract it by the hero's index. Light that parallel faces reflect
// to and fro is a part of it (pane_walk.h). All wavelengths leave a pane with parallel faces in the direction
// they came, so all four stay unless it is thick.
#pragma once

#include <vector>

#include "tracer/panes/pane_walk.h"
#include "tracer/rays/connection_code.h"
#include "tracer/transport/find_hit.h"
#include "tracer/transport/scatterer.h"

namespace vitrail {

// Its throughput is the radiance that it will deposit.
struct Connection : Traveller {
  FilmSample film;
  bool walks = false;            // through panes, to a distant light
  bool passes_veils = false;     // to a lamp that fades as POV-Ray's: fog does not weaken it
  std::uint8_t light_group = 0;  // as GroupedLights says
  // These members are of a connection that goes straight.
  StraightAim straight;
  double left = 0;  // of its way, in lengths of its direction; rounded as it travels
  // These members are of a connection that walks.
  RefractedAim refracted;
  std::uint32_t walk = 0;  // bits of a PaneWalk
};

// These connections wait to be traced together: one of each path of a wave at most.
struct Connections {
  std::vector<Connection> begun;
  std::vector<Connection*> live;  // of those that are traced together
};

// Adds a connection of a path; the caller gives it its way.
Connection& add_connection(const CameraPath& path, Connections& waiting);
// Gives a connection that goes straight its end, in lengths of its direction, and the slope of its light
// there.
void end_at(Connection& connection, double end, double slope);

// Traces the connections that begin here, and leaves none of them.
void trace(Tracing& tracing, Connections& waiting);
// Goes on with a connection in `at`.
void resume(Tracing& tracing, const ConnectionRecord& record, const Arrival& at);
void pack(const Tracing& tracing, const Connection& connection, bool resolved, RayRecord& record);

// They take a connection that walks on, or back, at a smooth face or a sheet. They return false where it
// ends.
bool walk_interface(Tracing& tracing, Connection& connection, const Interaction& at, const Surface& surface);
bool walk_sheet(const Tracing& tracing, Connection& connection, const Interaction& at,
                const Surface& surface);
// Lets a connection go on by chance. Its mean is the same however many faces there are, and however often
// light goes to and fro. Returns false where it ends.
bool walks_on(Connection& connection);
// Applies what is absorbed on its way.
void fade(Connection& connection, const SampledSpectrum& transmitted);
// Returns the numbers of the point of the sun's disc that all of a sample's connections go to. A connection
// that glass has turned can thus tell whether it has come there.
std::array<float, 2> numbers_for_far_lights(const Tracing& tracing, const SampleKey& key);
// Returns the share that a surface lets straight through.
SampledSpectrum straight_through(const Tracing& tracing, const Traveller& t, const Interaction& at,
                                 const Surface& surface);

}  // namespace vitrail
