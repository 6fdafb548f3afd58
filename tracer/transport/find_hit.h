// SPDX-License-Identifier: Apache-2.0
// What a ray meets, domain by domain.
#pragma once

#include <optional>

#include "tracer/transport/traveller.h"

namespace vitrail {

// Where a ray has to be to go on: in a domain that is not resident. `resolved`: its hit there is certain.
struct Elsewhere {
  std::uint32_t domain;
  bool resolved;
};
// A ray that was sent to `domain`, which is resident.
struct Arrival {
  std::uint32_t domain;
  bool resolved;
};

// Whether a ray that begins takes all domains at hand at once, by the scene's tree of domains. Else it goes
// from one into the next: where its way is recorded, or its crossings are counted.
bool goes_by_tree(const Tracing& tracing, const Ray& ray);

// Empty when the hit, or that there is none, is certain and its domain at hand.
std::optional<Elsewhere> find_hit(Tracing& tracing, Traveller& t, const std::optional<Arrival>& at);

// What every record has of a ray that goes on elsewhere, and back: `t` has its seed.
RayRecordHead head_of(const Traveller& t, RayRecordKind kind, bool resolved);
void unpack_head(const RayRecordHead& head, Traveller& t);
// Puts it into the outbox.
template <class T>
void send(Tracing& tracing, const T& traveller, const Elsewhere& to) {
  RayRecord record{};
  pack(tracing, traveller, to.resolved, record);
  tracing.outbox.rays.push_back({to.domain, record});
  if (tracing.traffic) tracing.traffic->leave_for(to.domain);
}

}  // namespace vitrail
