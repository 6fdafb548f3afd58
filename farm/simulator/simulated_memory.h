// SPDX-License-Identifier: Apache-2.0
// It is the part of the scene that a simulated rank has in memory: resident domains, those whose load is
// under way, and those that left the table while workers still hold them. Objects count once.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "bundle/manifest.h"
#include "farm/scheduler/residency.h"

namespace vitrail {

class SimulatedMemory {
 public:
  SimulatedMemory(const Manifest& manifest, int rank) : manifest_(manifest), rank_(rank) {}

  const std::set<std::uint32_t>& resident() const { return resident_; }
  // They are the loads under way, with the objects that each brings.
  const std::map<std::uint32_t, std::vector<std::uint32_t>>& loads() const { return loads_; }
  std::set<std::uint32_t> resident_and_loading() const;
  std::uint64_t table_bytes() const;                  // of these
  std::uint64_t held_bytes() const { return held_; }  // mapped or reserved
  std::uint64_t most_bytes() const { return most_; }
  std::uint64_t steps() const { return steps_; }  // taken

  // Evicts and reserves; returns the bytes that its load brings. Throws InvariantBroken where the step evicts
  // what is absent or loads what is there.
  std::uint64_t take(const LoadStep& step);
  void finish_load(std::uint32_t domain);
  // Lets go of what was evicted in the first so many steps, which workers no longer hold. Returns its bytes.
  std::uint64_t release(std::uint64_t steps);

 private:
  struct Evicted {
    std::uint64_t step = 0;
    std::uint64_t bytes = 0;
  };

  void evict(std::uint32_t domain);
  std::uint64_t begin_load(const LoadStep::Load& load);

  const Manifest& manifest_;
  int rank_;
  std::set<std::uint32_t> resident_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> loads_;
  std::vector<Evicted> evicted_;
  std::uint64_t steps_ = 0, held_ = 0, most_ = 0;
};

}  // namespace vitrail
