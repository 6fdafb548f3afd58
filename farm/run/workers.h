// SPDX-License-Identifier: Apache-2.0
// These are the threads of a rank: workers that generate and trace rays, and some that load domains.
#pragma once

#include <thread>
#include <vector>

#include "farm/run/rank_state.h"

namespace vitrail {

// Starts `threads` workers and the loaders; the destructor ends and joins them. Throws MachineError where the
// system makes no more threads.
class Workers {
 public:
  Workers(RankState& state, int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

 private:
  void end();

  RankState& state_;
  std::vector<std::jthread> threads_;
};

}  // namespace vitrail
