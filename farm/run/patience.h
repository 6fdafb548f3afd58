// SPDX-License-Identifier: Apache-2.0
// How long ranks wait for each other: who does not answer is named, and the job ends.
#pragma once

#include <functional>

#include "farm/run/rank_state.h"
#include "farm/scheduler/watch.h"
#include "farm/transport/transport.h"

namespace vitrail {

class Patience {
 public:
  // While it lives the transport's own waits are watched too.
  Patience(Transport& transport, const RankState& state, double patience_s);
  ~Patience();
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;

  // A round, or a step that all take together.
  void round_begins() { watch_.round_begins(state_.elapsed_s()); }
  void round_ends() { watch_.round_ends(); }
  // Answers those that ask whether this rank is well, and asks itself where a round does not end.
  void watch();
  // Does what may take longer than the others have patience with a rank, and answers them meanwhile.
  void answer_during(const std::function<void()>& work);

 private:
  void give_up();

  Transport& transport_;
  const RankState& state_;
  double patience_s_;
  Watch watch_;
};

}  // namespace vitrail
