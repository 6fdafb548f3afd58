// SPDX-License-Identifier: Apache-2.0
// Photons on their way from lights to where they are gathered.
#pragma once

#include "tracer/transport/find_hit.h"
#include "tracer/transport/scatterer.h"

namespace vitrail {

// That one of the iteration's.
void trace_photon(Tracing& tracing, std::uint32_t number);
// Goes on with one in `at`.
void resume(Tracing& tracing, const PhotonRecord& record, const Arrival& at);
void pack(const Tracing& tracing, const PhotonPath& photon, bool resolved, RayRecord& record);

}  // namespace vitrail
