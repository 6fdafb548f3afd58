// SPDX-License-Identifier: Apache-2.0
// These functions find what a ray meets, domain by domain.
#pragma once

#include <new>
#include <optional>

#include "tracer/rays/walk.h"
#include "tracer/transport/traveller.h"

namespace vitrail {

// It says where a ray has to be to go on: in a domain that is not resident. `resolved` says that its hit
// there is certain.
struct Elsewhere {
  std::uint32_t domain;
  bool resolved;
};
// It is a ray that was sent to `domain`, which is resident.
struct Arrival {
  std::uint32_t domain;
  bool resolved;
};

// Returns whether a ray that begins takes all domains at hand at once, by the scene's tree of domains. A ray
// goes from one into the next where its way is recorded, or its crossings are counted.
bool goes_by_tree(const Tracing& tracing, const Ray& ray);

// Finds the hit. Returns nothing when the hit, or that there is none, is certain and its domain at hand.
std::optional<Elsewhere> find_hit(Tracing& tracing, Traveller& t, const std::optional<Arrival>& at);

// It finds hits of rays that begin, 32 at a time, where the scene's only domain is resident and no way is
// recorded.
class HitsInOne {
 public:
  explicit HitsInOne(Tracing& tracing) : tracing_(tracing) {}
  // The traveller has to outlive its hit, which is found at the latest by `finish`.
  void add(Traveller& t) {
    if (!DomainWalk::starts_near(t.ray.origin)) return;
    new (rays_ + count_) RayConstants(prepare(t.ray, t.time_s));  // in place, as a copy costs much
    hits_[count_++] = &t.hit;
    t.hit_domain = 0;
    if (count_ == most_at_once) finish();
  }
  void finish() {
    tracing_.kernel.closest_of_many(*tracing_.resident[0], rays_, hits_, count_);
    count_ = 0;
  }

 private:
  static constexpr std::size_t most_at_once = 32;  // what the kernel reads of them stays in the first cache
  Tracing& tracing_;
  RayConstants rays_[most_at_once] = {};
  Hit* hits_[most_at_once] = {};
  std::size_t count_ = 0;
};

// They convert what every record has of a ray that goes on elsewhere, and back. `t` has its seed already.
RayRecordHead head_of(const Traveller& t, RayRecordKind kind, bool resolved);
void unpack_head(const RayRecordHead& head, Traveller& t);
// Puts the traveller into the outbox.
template <class T>
void send(Tracing& tracing, const T& traveller, const Elsewhere& to) {
  RayRecord record{};
  pack(tracing, traveller, to.resolved, record);
  tracing.outbox.rays.push_back({to.domain, record});
  if (tracing.traffic) tracing.traffic->leave_for(to.domain);
}

}  // namespace vitrail
