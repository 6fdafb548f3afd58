// SPDX-License-Identifier: Apache-2.0
#include "farm/residency.h"

#include <algorithm>

namespace vitrail {

namespace {

constexpr std::uint64_t rays_that_earn_a_replica = 16384;
// Without need, a resident domain makes room only for one with this many times its rays, and this many at
// least.
constexpr std::size_t worth_a_swap = 4, rays_worth_a_load = 4096;

}  // namespace

Residency::Residency(const Manifest& manifest, std::filesystem::path bundle, std::uint64_t budget_bytes,
                     std::vector<int> home, int rank)
    : manifest_(manifest),
      bundle_(std::move(bundle)),
      budget_(budget_bytes),
      home_(std::move(home)),
      local_(manifest.domains.size()),
      touched_(manifest.domains.size()),
      forwarded_(manifest.domains.size()),
      held_(std::make_shared<std::atomic<std::uint64_t>>(0)) {
  ResidentTable empty;
  empty.domains.resize(manifest.domains.size());
  empty.views.resize(manifest.domains.size());
  table_ = std::make_shared<const ResidentTable>(std::move(empty));
  std::uint64_t total = 0, at_home = 0;
  for (std::size_t d = 0; d < home_.size(); ++d) {
    total += manifest.domains[d].bytes;
    if (home_[d] == rank) at_home += manifest.domains[d].bytes;
  }
  for (std::size_t d = 0; d < home_.size(); ++d) local_[d] = total <= budget_ || home_[d] == rank;
  spare_ = at_home < budget_ ? budget_ - at_home : 0;
}

void Residency::note_forwarded(std::uint32_t domain, std::uint64_t rays) {
  forwarded_[domain] += rays;
  const std::uint64_t bytes = manifest_.domains[domain].bytes;
  if (local_[domain] || forwarded_[domain] < rays_that_earn_a_replica || bytes > spare_) return;
  spare_ -= bytes;
  local_[domain] = true;
}

std::optional<std::uint32_t> Residency::reserve(const std::function<std::size_t(std::uint32_t)>& waiting,
                                                std::size_t alive, bool starving) {
  std::optional<std::uint32_t> best;
  std::size_t most = 0;
  for (std::uint32_t d = 0; d < local_.size(); ++d)
    if (local_[d] && !resident(d) && waiting(d) > most) {
      most = waiting(d);
      best = d;
    }
  if (!best || !make_room(manifest_.domains[*best].bytes, most, waiting, alive, starving))
    return std::nullopt;
  *held_ += manifest_.domains[*best].bytes;
  return best;
}

bool Residency::make_room(std::uint64_t bytes, std::size_t candidate_waiting,
                          const std::function<std::size_t(std::uint32_t)>& waiting, std::size_t alive,
                          bool starving) {
  while (*held_ + bytes > budget_) {
    // What was evicted before and is still held by a worker will come free without further evictions.
    std::uint64_t in_table = 0;
    std::optional<std::uint32_t> victim;
    for (std::uint32_t d = 0; d < local_.size(); ++d) {
      if (!resident(d)) continue;
      in_table += manifest_.domains[d].bytes;
      if (!victim || waiting(d) < waiting(*victim)) victim = d;
    }
    if (!victim || in_table + bytes <= budget_) return false;
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

std::shared_ptr<const MappedDomain> Residency::load(std::uint32_t domain) {
  const std::uint64_t bytes = manifest_.domains[domain].bytes;
  const std::filesystem::path file = domain_path(bundle_, domain);
  auto mapped = std::make_unique<const MappedDomain>(file);
  check_domain(manifest_, domain, *mapped, file);
  return {mapped.release(), [held = held_, bytes](const MappedDomain* evicted) {
            delete evicted;
            *held -= bytes;
          }};
}

void Residency::insert(std::uint32_t domain, std::shared_ptr<const MappedDomain> mapped) {
  ++loads_;
  touched_[domain] = true;
  replace(domain, std::move(mapped));
}

void Residency::replace(std::uint32_t domain, std::shared_ptr<const MappedDomain> mapped) {
  auto next = std::make_shared<ResidentTable>(*table_);
  next->views[domain] = mapped ? &mapped->view() : nullptr;
  next->domains[domain] = std::move(mapped);
  table_ = std::move(next);
}

std::vector<int> home_ranks(const Manifest& manifest, int ranks) {
  std::uint64_t total = 0;
  for (const DomainInfo& d : manifest.domains) total += d.bytes;
  std::vector<int> home;
  std::uint64_t before = 0;
  for (const DomainInfo& d : manifest.domains) {
    const std::uint64_t middle = before + d.bytes / 2;
    home.push_back(total == 0 ? 0
                              : std::min(ranks - 1, static_cast<int>(
                                                        middle * static_cast<std::uint64_t>(ranks) / total)));
    before += d.bytes;
  }
  return home;
}

}  // namespace vitrail
