// SPDX-License-Identifier: Apache-2.0
#include "farm/scheduler/residency.h"

#include <algorithm>

#include "bundle/loaded_domain.h"

namespace vitrail {

namespace {

constexpr std::uint64_t rays_that_earn_a_replica = 16384;
// Without need, a resident domain makes room only for one with this many times its rays, and a ray at least
// for so many bytes that have to be read: tracing takes as long as a fast disk then.
constexpr std::uint64_t worth_a_swap = 4, bytes_worth_a_ray = 2048;

// Of those of the domain's objects that are not marked yet; marks them.
std::uint64_t mark_objects(const Manifest& manifest, std::uint32_t domain, std::vector<bool>& marked) {
  std::uint64_t bytes = 0;
  for (const std::uint32_t object : manifest.domains[domain].objects)
    if (!marked[object]) {
      bytes += manifest.objects[object].bytes;
      marked[object] = true;
    }
  return bytes;
}

}  // namespace

Residency::Residency(const Manifest& manifest, std::uint64_t budget_bytes, Homes homes, int rank,
                     Distribution distribution)
    : manifest_(manifest),
      budget_(budget_bytes),
      homes_(std::move(homes)),
      distribution_(distribution),
      everything_(distribution == Distribution::replicate ||
                  (distribution == Distribution::automatic && bytes_of_all(manifest) <= budget_bytes)),
      local_(manifest.domains.size()),
      local_objects_(manifest.objects.size()),
      state_(manifest.domains.size(), State::absent),
      waiting_(manifest.domains.size()),
      forwarded_(manifest.domains.size()),
      object_users_(manifest.objects.size()),
      object_is_loading_(manifest.objects.size()),
      resident_(manifest.domains.size()),
      absent_(manifest.domains.size()) {
  settle_in(rank);
}

// Decides by the homes what is local, when nothing is in absent_.
void Residency::settle_in(int rank) {
  std::uint64_t at_home = 0;
  for (std::uint32_t d = 0; d < homes_.domains(); ++d) {
    const bool home = homes_.has(d, rank);
    local_[d] = everything_ || home;
    if (local_[d] && state_[d] == State::absent) absent_.insert(d, waiting_[d]);
    if (home) at_home += bytes_loaded(manifest_, d) + mark_objects(manifest_, d, local_objects_);
  }
  places_ = distribution_ == Distribution::replicate
                ? homes_.domains() * static_cast<std::uint64_t>(homes_.ranks())
                : homes_.places();
  spare_ = at_home < budget_ ? budget_ - at_home : 0;
}

LoadStep Residency::settle(Homes homes, std::uint64_t budget_bytes, int rank) {
  homes_ = std::move(homes);
  budget_ = budget_bytes;
  local_objects_.assign(local_objects_.size(), false);
  forwarded_.assign(forwarded_.size(), 0);
  absent_ = Fullest(local_.size());
  settle_in(rank);
  LoadStep step;
  for (std::uint32_t d = 0; d < local_.size(); ++d)
    if (!local_[d] && state_[d] == State::resident) {
      evict(d);
      step.evicted.push_back(d);
    }
  return step;
}

void Residency::set_waiting(std::uint32_t domain, std::uint64_t rays) {
  waiting_[domain] = rays;
  if (state_[domain] == State::resident)
    resident_.set(domain, rays);
  else if (state_[domain] == State::absent)
    absent_.set(domain, rays);
}

void Residency::rays_wait(std::uint32_t domain, std::uint64_t rays) {
  set_waiting(domain, waiting_[domain] + rays);
}
void Residency::rays_taken(std::uint32_t domain, std::uint64_t rays) {
  set_waiting(domain, waiting_[domain] - rays);
}

void Residency::rays_forwarded(std::uint32_t domain, std::uint64_t rays) {
  if (distribution_ == Distribution::decompose) return;
  forwarded_[domain] += rays;
  if (local_[domain] || forwarded_[domain] < rays_that_earn_a_replica) return;
  std::vector<bool> objects = local_objects_;
  const std::uint64_t bytes = bytes_loaded(manifest_, domain) + mark_objects(manifest_, domain, objects);
  if (bytes > spare_) return;
  spare_ -= bytes;
  local_[domain] = true;
  absent_.insert(domain, 0);
  local_objects_ = std::move(objects);
}

// Gives the bytes of the objects that had none before.
std::uint64_t Residency::add_users(std::uint32_t domain, std::vector<std::uint32_t>* missing) {
  std::uint64_t bytes = 0;
  for (const std::uint32_t object : manifest_.domains[domain].objects)
    if (!manifest_.objects[object].quadric && object_users_[object]++ == 0) {
      bytes += manifest_.objects[object].bytes;
      missing->push_back(object);
    }
  return bytes;
}

// Gives the bytes of the objects that have none now.
std::uint64_t Residency::remove_users(std::uint32_t domain) {
  std::uint64_t bytes = 0;
  for (const std::uint32_t object : manifest_.domains[domain].objects)
    if (!manifest_.objects[object].quadric && --object_users_[object] == 0)
      bytes += manifest_.objects[object].bytes;
  return bytes;
}

// Whatever of its objects is in memory stays there meanwhile. What another load brings is waited for.
LoadStep Residency::loader_is_free(std::uint64_t alive, bool starving) {
  LoadStep step;
  const std::optional<std::uint32_t> best = absent_.most();
  if (!best || std::ranges::any_of(manifest_.domains[*best].objects,
                                   [&](std::uint32_t object) { return object_is_loading_[object]; }))
    return step;
  LoadStep::Load load{*best, {}};
  const std::uint64_t own = bytes_loaded(manifest_, *best), objects = add_users(*best, &load.missing);
  in_table_ += objects;
  if (!make_room(*best, own + objects, alive, starving, step.evicted)) {
    in_table_ -= remove_users(*best);
    return step;
  }
  held_ += own + objects;
  in_table_ += own;
  absent_.erase(*best);
  state_[*best] = State::loading;
  for (const std::uint32_t object : load.missing) object_is_loading_[object] = true;
  step.load = std::move(load);
  return step;
}

void Residency::evict(std::uint32_t domain) {
  ++evictions_;
  resident_.erase(domain);
  state_[domain] = State::absent;
  in_table_ -= bytes_loaded(manifest_, domain) + remove_users(domain);
}

bool Residency::make_room(std::uint32_t wanted, std::uint64_t bytes, std::uint64_t alive, bool starving,
                          std::vector<std::uint32_t>& evicted) {
  while (held_ + bytes > budget_) {
    // What was evicted before and is still held by a worker will come free without further evictions.
    if (in_table_ + bytes_loaded(manifest_, wanted) <= budget_) return false;
    const std::optional<std::uint32_t> victim = resident_.fewest();
    if (!victim) return false;
    const std::uint64_t fewest = waiting_[*victim], candidate = waiting_[wanted];
    const bool worthwhile = candidate * bytes_worth_a_ray >= bytes && fewest * worth_a_swap <= candidate;
    // Even in need a swap waits until a domain has its even share of the rays alive: a rank with little to do
    // would else swap for a handful of rays over and over while the others work. Where most rays wait there
    // is always such a share, so somewhere work goes on: twice, since the fullest that is found may have
    // half.
    const bool needed = starving && 2 * candidate * places_ >= alive;
    if (fewest >= candidate || !(needed || worthwhile)) return false;
    evict(*victim);
    evicted.push_back(*victim);
    absent_.insert(*victim, fewest);
  }
  return true;
}

void Residency::loaded(std::uint32_t domain) {
  ++loads_;
  for (const std::uint32_t object : manifest_.domains[domain].objects) object_is_loading_[object] = false;
  state_[domain] = State::resident;
  resident_.insert(domain, waiting_[domain]);
}

std::uint64_t bytes_of_all(const Manifest& manifest) {
  std::uint64_t bytes = 0;
  for (std::uint32_t d = 0; d < manifest.domains.size(); ++d) bytes += bytes_loaded(manifest, d);
  for (const ObjectInfo& o : manifest.objects) bytes += o.bytes;
  return bytes;
}

bool is_in_flow(const Manifest& manifest, const Homes& homes, Distribution distribution,
                std::uint64_t bytes_a_rank) {
  const bool by_work = homes.places() > homes.domains(), all_fits = bytes_of_all(manifest) <= bytes_a_rank;
  if (!by_work || distribution == Distribution::replicate) return false;
  if (all_fits) return distribution == Distribution::decompose;
  return most_bytes_at_home(manifest, homes) <= bytes_a_rank;
}

}  // namespace vitrail
