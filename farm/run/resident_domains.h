// SPDX-License-Identifier: Apache-2.0
// They hold the domains and objects that are mapped, as scheduler/residency.h decides.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <span>

#include "bundle/loaded_domain.h"
#include "farm/scheduler/residency.h"
#include "tracer/intersect/traversal.h"

namespace vitrail {

// It holds the resident domains at one moment. A worker keeps its own reference while it traces, so a domain
// that is evicted meanwhile is unmapped when the last worker lets go of it.
struct ResidentTable {
  std::vector<std::shared_ptr<const DomainView>> domains;  // with their files
  std::vector<const DomainView*> views;
};

// It is for a domain that has room, and holds those of its objects that are in memory already.
struct Reservation {
  LoadStep::Load load;
  std::map<std::uint32_t, SharedDomain> held;  // by number
  bool again = false;                          // the domain was loaded before
};

// It is not synchronised, except `load`: the rank's mutex guards it. No two loads under way bring the same
// object.
class ResidentDomains {
 public:
  ResidentDomains(const Manifest& manifest, std::filesystem::path bundle, Traversal traversal);

  std::shared_ptr<const ResidentTable> table() const { return table_; }
  // All views are of EmbreeDomains if this is Embree's.
  Traversal traversal() const { return traversal_; }
  // It has a bit a domain: it was loaded at least once.
  const std::vector<bool>& touched() const { return touched_; }

  // Lets the evicted go, but keeps the objects of theirs that the load needs.
  std::optional<Reservation> begin(LoadStep step);
  // Maps and verifies the domain, and builds Embree's tree if that is wanted; may be called without the
  // mutex.
  std::shared_ptr<const DomainView> load(const Reservation& reservation);
  void insert(std::uint32_t domain, std::shared_ptr<const DomainView> loaded);
  // Returns the bytes unmapped since it was asked last. Workers let go without a notice.
  std::uint64_t take_released() { return released_->exchange(0); }

 private:
  SharedDomain counted(SharedDomain mapped, std::uint64_t bytes) const;

  const Manifest& manifest_;
  std::filesystem::path bundle_;
  Traversal traversal_;
  OpenPacks packs_;
  std::vector<bool> touched_;
  std::vector<std::weak_ptr<const MappedDomain>> objects_;  // by number
  std::vector<std::uint8_t> objects_touched_;               // by number: 1 if it was loaded
  std::shared_ptr<std::atomic<std::uint64_t>> released_;    // bytes
  std::shared_ptr<const ResidentTable> table_;
};

}  // namespace vitrail
