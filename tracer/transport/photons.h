// SPDX-License-Identifier: Apache-2.0
// These functions trace photons on their way from lights to where they are gathered.
#pragma once

#include "tracer/transport/find_hit.h"
#include "tracer/transport/scatterer.h"

namespace vitrail {

// Traces the iteration's photon of that number.
void trace_photon(Tracing& tracing, std::uint32_t number);
// Goes on with a photon in `at`.
void resume(Tracing& tracing, const PhotonRecord& record, const Arrival& at);
void pack(const Tracing& tracing, const PhotonPath& photon, bool resolved, RayRecord& record);

}  // namespace vitrail
