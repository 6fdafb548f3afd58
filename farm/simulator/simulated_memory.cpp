// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/simulated_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "bundle/loaded_domain.h"
#include "farm/simulator/invariants.h"

namespace vitrail {

std::set<std::uint32_t> SimulatedMemory::resident_and_loading() const {
  std::set<std::uint32_t> domains = resident_;
  for (const auto& [domain, objects] : loads_) domains.insert(domain);
  return domains;
}

std::uint64_t SimulatedMemory::table_bytes() const {
  std::vector<bool> counted(manifest_.objects.size());
  std::uint64_t bytes = 0;
  for (const std::uint32_t domain : resident_and_loading()) {
    bytes += bytes_loaded(manifest_, domain);
    for (const std::uint32_t o : manifest_.domains[domain].objects)
      if (!counted[o]) {
        counted[o] = true;
        bytes += manifest_.objects[o].bytes;
      }
  }
  return bytes;
}

std::uint64_t SimulatedMemory::take(const LoadStep& step) {
  ++steps_;
  for (const std::uint32_t domain : step.evicted) evict(domain);
  const std::uint64_t reserved = step.load ? begin_load(*step.load) : 0;
  if (!step.evicted.empty()) {
    // What no resident domain and no load needs any more leaves memory with the last worker that began
    // before.
    std::uint64_t kept = table_bytes();
    for (const Evicted& e : evicted_) kept += e.bytes;
    if (held_ + reserved < kept) invariant::broken("bytes are miscounted");
    evicted_.push_back({steps_, held_ + reserved - kept});
  }
  held_ += reserved;
  most_ = std::max(most_, held_);
  return reserved;
}

void SimulatedMemory::evict(std::uint32_t domain) {
  if (resident_.erase(domain) == 0) invariant::broken(fmt::format("rank {} evicts an absent domain", rank_));
}

std::uint64_t SimulatedMemory::begin_load(const LoadStep::Load& load) {
  if (resident_.contains(load.domain) || loads_.contains(load.domain))
    invariant::broken(fmt::format("rank {} loads domain {} twice", rank_, load.domain));
  loads_.emplace(load.domain, load.missing);
  std::uint64_t bytes = bytes_loaded(manifest_, load.domain);
  for (const std::uint32_t o : load.missing) bytes += manifest_.objects[o].bytes;
  return bytes;
}

void SimulatedMemory::finish_load(std::uint32_t domain) {
  loads_.erase(domain);
  resident_.insert(domain);
}

std::uint64_t SimulatedMemory::release(std::uint64_t steps) {
  std::uint64_t bytes = 0;
  std::erase_if(evicted_, [&](const Evicted& e) {
    if (e.step > steps) return false;
    bytes += e.bytes;
    return true;
  });
  held_ -= bytes;
  return bytes;
}

}  // namespace vitrail
