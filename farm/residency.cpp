// SPDX-License-Identifier: Apache-2.0
#include "farm/residency.h"

#include <algorithm>

namespace vitrail {

namespace {

constexpr std::uint64_t rays_that_earn_a_replica = 16384;
// Without need, a resident domain makes room only for one with this many times its rays, and this many at
// least.
constexpr std::size_t worth_a_swap = 4, rays_worth_a_load = 4096;

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

Residency::Residency(const Manifest& manifest, std::filesystem::path bundle, std::uint64_t budget_bytes,
                     std::vector<int> home, int rank)
    : manifest_(manifest),
      bundle_(std::move(bundle)),
      budget_(budget_bytes),
      home_(std::move(home)),
      local_(manifest.domains.size()),
      touched_(manifest.domains.size()),
      local_objects_(manifest.objects.size()),
      objects_(manifest.objects.size()),
      forwarded_(manifest.domains.size()),
      held_(std::make_shared<std::atomic<std::uint64_t>>(0)) {
  ResidentTable empty;
  empty.domains.resize(manifest.domains.size());
  empty.views.resize(manifest.domains.size());
  table_ = std::make_shared<const ResidentTable>(std::move(empty));
  const bool everything = bytes_of_all(manifest) <= budget_;
  std::uint64_t at_home = 0;
  for (std::uint32_t d = 0; d < home_.size(); ++d) {
    local_[d] = everything || home_[d] == rank;
    if (home_[d] == rank) at_home += manifest.domains[d].bytes + mark_objects(manifest, d, local_objects_);
  }
  spare_ = at_home < budget_ ? budget_ - at_home : 0;
}

void Residency::note_forwarded(std::uint32_t domain, std::uint64_t rays) {
  forwarded_[domain] += rays;
  if (local_[domain] || forwarded_[domain] < rays_that_earn_a_replica) return;
  std::vector<bool> objects = local_objects_;
  const std::uint64_t bytes = manifest_.domains[domain].bytes + mark_objects(manifest_, domain, objects);
  if (bytes > spare_) return;
  spare_ -= bytes;
  local_[domain] = true;
  local_objects_ = std::move(objects);
}

// Whatever of its objects is in memory stays there as long as the reservation.
Reservation Residency::reservation_for(std::uint32_t domain) const {
  Reservation r{domain, {}, {}};
  for (const std::uint32_t object : manifest_.domains[domain].objects) {
    if (manifest_.objects[object].quadric) continue;
    if (SharedDomain held = objects_[object].lock())
      r.held.emplace(object, std::move(held));
    else
      r.missing.push_back(object);
  }
  return r;
}

std::optional<Reservation> Residency::reserve(const std::function<std::size_t(std::uint32_t)>& waiting,
                                              std::size_t alive, bool starving) {
  std::optional<std::uint32_t> best;
  std::size_t most = 0;
  for (std::uint32_t d = 0; d < local_.size(); ++d)
    if (local_[d] && !resident(d) && waiting(d) > most) {
      most = waiting(d);
      best = d;
    }
  if (!best) return std::nullopt;
  Reservation wanted = reservation_for(*best);
  std::uint64_t bytes = manifest_.domains[*best].bytes;
  for (const std::uint32_t object : wanted.missing) bytes += manifest_.objects[object].bytes;
  if (!make_room(wanted, bytes, waiting, alive, starving)) return std::nullopt;
  *held_ += bytes;
  return wanted;
}

// Of what the table and a reservation keep in memory, without what workers still hold of earlier tables.
std::uint64_t Residency::bytes_in_table(const Reservation& wanted) const {
  std::vector<bool> counted(manifest_.objects.size());
  std::uint64_t bytes = 0;
  for (const auto& [object, mapped] : wanted.held) {
    counted[object] = true;
    bytes += manifest_.objects[object].bytes;
  }
  for (std::uint32_t d = 0; d < local_.size(); ++d)
    if (resident(d)) bytes += manifest_.domains[d].bytes + mark_objects(manifest_, d, counted);
  return bytes;
}

bool Residency::make_room(const Reservation& wanted, std::uint64_t bytes,
                          const std::function<std::size_t(std::uint32_t)>& waiting, std::size_t alive,
                          bool starving) {
  const std::size_t candidate_waiting = waiting(wanted.domain);
  while (*held_ + bytes > budget_) {
    // What was evicted before and is still held by a worker will come free without further evictions.
    if (bytes_in_table(wanted) + bytes <= budget_) return false;
    std::optional<std::uint32_t> victim;
    for (std::uint32_t d = 0; d < local_.size(); ++d)
      if (resident(d) && (!victim || waiting(d) < waiting(*victim))) victim = d;
    if (!victim) return false;
    const std::size_t fewest = waiting(*victim);
    const bool worthwhile =
        candidate_waiting >= rays_worth_a_load && fewest * worth_a_swap <= candidate_waiting;
    // Even in need a swap waits until a domain has its even share of the rays alive: a rank with little to do
    // would else swap for a handful of rays over and over while the others work. The domain with the most
    // rays always has its share, so somewhere work goes on.
    const bool needed = starving && candidate_waiting * local_.size() >= alive;
    if (fewest >= candidate_waiting || !(needed || worthwhile)) return false;
    ++evictions_;
    replace(*victim, nullptr);
  }
  return true;
}

// The same file, which is no longer counted as held when it is let go.
SharedDomain Residency::counted(SharedDomain mapped) const {
  const MappedDomain* const file = mapped.get();
  return {file, [mapped = std::move(mapped), held = held_](const MappedDomain*) mutable {
            const std::uint64_t bytes = mapped->bytes();
            mapped.reset();
            *held -= bytes;
          }};
}

std::shared_ptr<const LoadedDomain> Residency::load(const Reservation& reservation) {
  const auto object = [&](std::uint32_t number) {
    if (const auto held = reservation.held.find(number); held != reservation.held.end()) return held->second;
    SharedDomain mapped = counted(map_object(manifest_, bundle_, number));
    objects_[number] = mapped;
    return mapped;
  };
  return std::make_shared<const LoadedDomain>(
      manifest_, reservation.domain, counted(map_domain(manifest_, bundle_, reservation.domain)), object);
}

void Residency::insert(std::uint32_t domain, std::shared_ptr<const LoadedDomain> loaded) {
  ++loads_;
  touched_[domain] = true;
  replace(domain, std::move(loaded));
}

void Residency::replace(std::uint32_t domain, std::shared_ptr<const LoadedDomain> loaded) {
  auto next = std::make_shared<ResidentTable>(*table_);
  next->views[domain] = loaded ? &loaded->view() : nullptr;
  next->domains[domain] = std::move(loaded);
  table_ = std::move(next);
}

std::uint64_t bytes_of_all(const Manifest& manifest) {
  std::uint64_t bytes = 0;
  for (const DomainInfo& d : manifest.domains) bytes += d.bytes;
  for (const ObjectInfo& o : manifest.objects) bytes += o.bytes;
  return bytes;
}

std::vector<int> home_ranks(const Manifest& manifest, int ranks) {
  std::uint64_t total = 0;
  for (std::uint32_t d = 0; d < manifest.domains.size(); ++d) total += bytes_needed(manifest, d);
  std::vector<int> home;
  std::uint64_t before = 0;
  for (std::uint32_t d = 0; d < manifest.domains.size(); ++d) {
    const std::uint64_t bytes = bytes_needed(manifest, d), middle = before + bytes / 2;
    home.push_back(total == 0 ? 0
                              : std::min(ranks - 1, static_cast<int>(
                                                        middle * static_cast<std::uint64_t>(ranks) / total)));
    before += bytes;
  }
  return home;
}

}  // namespace vitrail
