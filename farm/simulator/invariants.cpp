// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/invariants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace vitrail::invariant {

void broken(const std::string& what) { throw InvariantBroken(what); }

void check_bytes(int rank, const SimulatedMemory& memory, std::uint64_t rays_bytes,
                 const Residency& residency, const Machine& machine) {
  const std::uint64_t bytes = memory.held_bytes();
  if (bytes != residency.held_bytes())
    broken(fmt::format("rank {} holds {} bytes and counts {}", rank, bytes, residency.held_bytes()));
  if (rays_bytes > machine.queue_bytes)
    broken(fmt::format("rank {} holds {} bytes of rays of {}", rank, rays_bytes, machine.queue_bytes));
  if (bytes > machine.domain_bytes)
    broken(fmt::format("rank {} holds {} bytes of {}", rank, bytes, machine.domain_bytes));
}

void check_load(int rank, const SimulatedMemory& memory, const LoadStep::Load& load,
                const Manifest& manifest) {
  std::set<std::uint32_t> there;
  for (const std::uint32_t domain : memory.resident_and_loading())
    for (const std::uint32_t object : manifest.domains[domain].objects) there.insert(object);
  for (const auto& [domain, objects] : memory.loads())
    for (const std::uint32_t object : objects) there.erase(object);
  there.insert(load.missing.begin(), load.missing.end());
  for (const std::uint32_t object : manifest.domains[load.domain].objects)
    if (!there.contains(object))
      broken(fmt::format("rank {} loads domain {} without object {}", rank, load.domain, object));
}

void check_table(int rank, const SimulatedMemory& memory, const Residency& residency) {
  const std::uint64_t bytes = memory.table_bytes(), counted = residency.table_bytes();
  if (bytes != counted)
    broken(fmt::format("rank {} has {} bytes in its table and counts {}", rank, bytes, counted));
}

void check_queue(int rank, std::uint32_t domain, std::uint64_t rays, const Residency& residency) {
  const std::uint64_t counted = residency.waiting(domain);
  if (rays != counted)
    broken(
        fmt::format("{} rays wait for domain {} on rank {}, which counts {}", rays, domain, rank, counted));
}

void check_silent(int rank, const Silence& silence, const Mishaps& mishaps, const SimulatedMachine& machine) {
  const Machine& costs = machine.costs();
  const double longest_way_s = costs.latency_s * (1 + costs.jitter);
  if (silence.from_s > machine.now_s() ||
      silence.to_s - silence.from_s < costs.patience_s / 2 - 2 * longest_way_s)
    broken(fmt::format("rank {} is well and was given up", rank));
  double all_awake_s = 0;  // but for the dead
  for (const Silence& s : mishaps.silences)
    all_awake_s = std::max(all_awake_s, std::isfinite(s.to_s) ? s.to_s : s.from_s);
  if (machine.now_s() >
      all_awake_s + 3 * costs.patience_s + costs.round_interval_s * (1 + costs.jitter) + 32 * longest_way_s)
    broken(fmt::format("rank {} was silent since {} s", rank, silence.from_s));
}

void check_generated(std::uint64_t rays, const KeptWork& before, const KeptWork& now,
                     const Workload& workload) {
  const auto all_items = [&](const KeptWork& w) {
    return static_cast<std::uint64_t>(w.rounds) * workload.items + w.items;
  };
  const std::uint64_t items = all_items(now) - all_items(before);
  if (rays != items * workload.rays_an_item)
    broken(
        fmt::format("{} camera rays were generated for {} items of {}", rays, items, workload.rays_an_item));
}

void check_agreement(const std::map<std::uint64_t, std::size_t>& ranks_by_round, std::size_t ranks,
                     const char* conclusion) {
  for (const auto& [round, those] : ranks_by_round)
    if (those != ranks) broken(fmt::format("in round {} only {} ranks {}", round, those, conclusion));
}

}  // namespace vitrail::invariant
