// SPDX-License-Identifier: Apache-2.0
// These rounds of a simulated job are under way: some ranks have joined, or not all have left.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "farm/scheduler/round.h"

namespace vitrail {

class SimulatedRounds {
 public:
  explicit SimulatedRounds(int ranks) : ranks_(static_cast<std::size_t>(ranks)) {}

  // Returns whether all ranks have joined it now.
  bool join(std::uint64_t round, int rank, const RoundSums& mine, const RankReport& report);

  struct Told {
    RoundSums sums;
    std::shared_ptr<const std::vector<RankReport>> reports;
  };
  // Returns the sums and reports that each rank is told at the end.
  Told leave(std::uint64_t round);

 private:
  struct Open {
    std::size_t joined = 0, left = 0;
    RoundSums sums;
    std::shared_ptr<std::vector<RankReport>> reports;
  };

  std::size_t ranks_;
  std::map<std::uint64_t, Open> open_;  // by number
};

}  // namespace vitrail
