// SPDX-License-Identifier: Apache-2.0
// A Residency decides which domains a rank keeps in memory: the one with the most waiting rays is loaded, the
// one with the fewest makes room. farm/run/resident_domains.h carries the decisions out.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bundle/manifest.h"
#include "farm/scheduler/fullest.h"
#include "farm/scheduler/homes.h"

namespace vitrail {

// A Distribution says which domains a rank traces in, whatever of them is in memory: all, or those that it
// answers for. `automatic` means all where they fit into memory, else its own and those that it has sent many
// rays for.
enum class Distribution : std::uint8_t { automatic, decompose, replicate };

// It is the number of loads that may be under way at once: a disk that is far away answers several as soon as
// one (docs/why/scheduler.md, "Loads").
inline constexpr int loaders_of_a_rank = 8;

// A LoadStep says what a loader does next: first some domains leave, then one is mapped, where there is room
// for it already.
struct LoadStep {
  struct Load {
    std::uint32_t domain = 0;
    std::vector<std::uint32_t>
        missing;  // its objects that are to be mapped, ascending; the others are in memory
  };
  std::vector<std::uint32_t> evicted;
  std::optional<Load> load;
};

// Domains share the objects that several need; an object is counted once.
class Residency {
 public:
  // `budget_bytes` is for mapped domains and objects. Of the manifest it reads the sizes, and which domain
  // needs which objects.
  Residency(const Manifest& manifest, std::uint64_t budget_bytes, Homes homes, int rank,
            Distribution distribution = Distribution::automatic);

  // Returns whether rays for the domain wait here; otherwise they go to one of its homes.
  bool is_local(std::uint32_t domain) const { return local_[domain]; }
  bool all_are_local() const { return everything_; }
  const Homes& homes() const { return homes_; }
  std::uint64_t waiting(std::uint32_t domain) const { return waiting_[domain]; }
  // Returns the resident domain that most rays wait for, if any do.
  std::optional<std::uint32_t> fullest() const { return resident_.most(); }
  // Returns the bytes that are mapped or reserved, with those that were evicted and are not yet let go.
  std::uint64_t held_bytes() const { return held_; }
  std::uint64_t table_bytes() const { return in_table_; }  // of these, what is resident or being loaded
  std::uint64_t loads() const { return loads_; }
  std::uint64_t evictions() const { return evictions_; }

  // Events.
  void rays_wait(std::uint32_t domain, std::uint64_t rays);  // of a local domain
  void rays_taken(std::uint32_t domain, std::uint64_t rays);
  // Counts rays that left for a domain of another rank. A domain that gets many is kept here too, if it fits.
  void rays_forwarded(std::uint32_t domain, std::uint64_t rays);
  // Returns what a free loader does; others may be at work. `alive` are the rays of the whole job; `starving`
  // says that the workers have nothing else to do.
  LoadStep loader_is_free(std::uint64_t alive, bool starving);
  void loaded(std::uint32_t domain);
  // Gives the domains other homes, while no load is under way and no ray waits for a domain that loses its
  // home here. Such domains leave the memory: rays that come by would else be traced here.
  LoadStep settle(Homes homes, std::uint64_t budget_bytes, int rank);
  // Workers let go of so many bytes that were evicted.
  void released(std::uint64_t bytes) { held_ -= bytes; }

 private:
  enum class State : std::uint8_t { absent, loading, resident };

  void settle_in(int rank);
  void set_waiting(std::uint32_t domain, std::uint64_t rays);
  std::uint64_t add_users(std::uint32_t domain, std::vector<std::uint32_t>* missing);
  std::uint64_t remove_users(std::uint32_t domain);
  void evict(std::uint32_t domain);
  bool make_room(std::uint32_t wanted, std::uint64_t bytes, std::uint64_t alive, bool starving,
                 std::vector<std::uint32_t>& evicted);

  const Manifest& manifest_;
  std::uint64_t budget_, spare_ = 0;
  std::uint64_t places_ = 0;  // where rays may wait: domains, each as often as ranks trace in it
  Homes homes_;
  Distribution distribution_;
  bool everything_;  // is traced in here
  std::vector<bool> local_;
  std::vector<bool> local_objects_;          // that a domain kept here needs
  std::vector<State> state_;                 // by domain
  std::vector<std::uint64_t> waiting_;       // rays, by domain
  std::vector<std::uint64_t> forwarded_;     // rays, by domain
  std::vector<std::uint32_t> object_users_;  // resident domains and those being loaded, by object
  std::vector<bool> object_is_loading_;
  Fullest resident_, absent_;   // the latter of local domains
  std::uint64_t held_ = 0;      // bytes
  std::uint64_t in_table_ = 0;  // of which resident or being loaded, with all objects of these
  std::uint64_t loads_ = 0, evictions_ = 0;
};

// Returns the bytes of all domains and objects.
std::uint64_t bytes_of_all(const Manifest& manifest);

// Returns whether rays go from rank to rank and wait for no load: ranks have equal work, trace in the domains
// that they answer for, and keep all of these. Objects count in each domain that needs them.
bool is_in_flow(const Manifest& manifest, const Homes& homes, Distribution distribution,
                std::uint64_t bytes_a_rank);

}  // namespace vitrail
