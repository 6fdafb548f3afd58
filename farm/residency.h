// SPDX-License-Identifier: Apache-2.0
// Which domains a rank keeps in memory. Loads run in the background; the domain with the most waiting rays is
// loaded, the one with the fewest makes room.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "bundle/loaded_domain.h"
#include "tracer/path_tracer.h"

namespace vitrail {

// The resident domains at one moment. A worker keeps its own reference while it traces, so a domain that is
// evicted meanwhile is unmapped when the last worker lets go of it.
struct ResidentTable {
  std::vector<std::shared_ptr<const LoadedDomain>> domains;
  std::vector<const DomainView*> views;
};

// A domain that has room, and those of its objects that are in memory already.
struct Reservation {
  std::uint32_t domain = 0;
  std::vector<std::uint32_t> missing;          // objects to be mapped, ascending
  std::map<std::uint32_t, SharedDomain> held;  // by number
};

// Objects are shared by the domains that need them, and counted once. Not synchronised, except `load`: the
// rank's mutex guards it. One thread reserves and loads.
class Residency {
 public:
  // `budget_bytes` for mapped domains and objects; `home[d]` is the rank that answers for domain d.
  Residency(const Manifest& manifest, std::filesystem::path bundle, std::uint64_t budget_bytes,
            std::vector<int> home, int rank);

  std::shared_ptr<const ResidentTable> table() const { return table_; }
  bool resident(std::uint32_t domain) const { return table_->views[domain] != nullptr; }
  // Whether rays for the domain wait here; otherwise they go to `home`.
  bool is_local(std::uint32_t domain) const { return local_[domain]; }
  int home(std::uint32_t domain) const { return home_[domain]; }
  // Tells that rays for a domain of another rank left: a domain much asked for is kept here too, if it fits.
  void note_forwarded(std::uint32_t domain, std::uint64_t rays);

  // The domain to load now, room made for it and reserved; empty while there is none or until workers let go
  // of what was evicted. `waiting(d)` counts the rays for d, `alive` those in the whole job; `starving`: the
  // workers have nothing else to do.
  std::optional<Reservation> reserve(const std::function<std::size_t(std::uint32_t)>& waiting,
                                     std::size_t alive, bool starving);
  // Maps and verifies; may be called without the mutex.
  std::shared_ptr<const LoadedDomain> load(const Reservation& reservation);
  void insert(std::uint32_t domain, std::shared_ptr<const LoadedDomain> loaded);

  std::uint64_t loads() const { return loads_; }
  std::uint64_t evictions() const { return evictions_; }
  // A bit a domain: it was loaded at least once.
  const std::vector<bool>& touched() const { return touched_; }

 private:
  Reservation reservation_for(std::uint32_t domain) const;
  bool make_room(const Reservation& wanted, std::uint64_t bytes,
                 const std::function<std::size_t(std::uint32_t)>& waiting, std::size_t alive, bool starving);
  std::uint64_t bytes_in_table(const Reservation& wanted) const;
  void replace(std::uint32_t domain, std::shared_ptr<const LoadedDomain> loaded);
  SharedDomain counted(SharedDomain mapped) const;

  const Manifest& manifest_;
  std::filesystem::path bundle_;
  std::uint64_t budget_, spare_ = 0;
  std::vector<int> home_;
  std::vector<bool> local_, touched_;
  std::vector<bool> local_objects_;                         // that a domain kept here needs
  std::vector<std::weak_ptr<const MappedDomain>> objects_;  // by number
  std::vector<std::uint64_t> forwarded_;
  std::shared_ptr<std::atomic<std::uint64_t>>
      held_;  // bytes mapped or reserved, evicted ones until they are let go
  std::shared_ptr<const ResidentTable> table_;
  std::uint64_t loads_ = 0, evictions_ = 0;
};

// Of all domains and objects.
std::uint64_t bytes_of_all(const Manifest& manifest);

// Contiguous runs of domains in kd order, of about equal bytes: neighbours share a rank and rays stay home
// longer.
std::vector<int> home_ranks(const Manifest& manifest, int ranks);

}  // namespace vitrail
