// SPDX-License-Identifier: Apache-2.0
// Which domains a rank keeps in memory. Loads run in the background; the domain with the most waiting rays is
// loaded, the one with the fewest makes room.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "bundle/manifest.h"
#include "tracer/path_tracer.h"

namespace vitrail {

// The resident domains at one moment. A worker keeps its own reference while it traces, so a domain that is
// evicted meanwhile is unmapped when the last worker lets go of it.
struct ResidentTable {
  std::vector<std::shared_ptr<const MappedDomain>> domains;
  std::vector<const DomainView*> views;
};

// Not synchronised, except `load`: the rank's mutex guards it.
class Residency {
 public:
  // `budget_bytes` for mapped domains; `home[d]` is the rank that answers for domain d.
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
  std::optional<std::uint32_t> reserve(const std::function<std::size_t(std::uint32_t)>& waiting,
                                       std::size_t alive, bool starving);
  // Maps and verifies; may be called without the mutex.
  std::shared_ptr<const MappedDomain> load(std::uint32_t domain);
  void insert(std::uint32_t domain, std::shared_ptr<const MappedDomain> mapped);

  std::uint64_t loads() const { return loads_; }
  std::uint64_t evictions() const { return evictions_; }
  // A bit a domain: it was loaded at least once.
  const std::vector<bool>& touched() const { return touched_; }

 private:
  bool make_room(std::uint64_t bytes, std::size_t candidate_waiting,
                 const std::function<std::size_t(std::uint32_t)>& waiting, std::size_t alive, bool starving);
  void replace(std::uint32_t domain, std::shared_ptr<const MappedDomain> mapped);

  const Manifest& manifest_;
  std::filesystem::path bundle_;
  std::uint64_t budget_, spare_ = 0;
  std::vector<int> home_;
  std::vector<bool> local_, touched_;
  std::vector<std::uint64_t> forwarded_;
  std::shared_ptr<std::atomic<std::uint64_t>>
      held_;  // bytes mapped or reserved, evicted ones until they are let go
  std::shared_ptr<const ResidentTable> table_;
  std::uint64_t loads_ = 0, evictions_ = 0;
};

// Contiguous runs of domains in kd order, of about equal bytes: neighbours share a rank and rays stay home
// longer.
std::vector<int> home_ranks(const Manifest& manifest, int ranks);

}  // namespace vitrail
