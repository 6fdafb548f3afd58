// SPDX-License-Identifier: Apache-2.0
// A job stalls when its ranks all answer and none of them has anything to do, though rays are alive: what was
// sent does not arrive, or nobody loads what they wait for. Stall, like the scheduler, has no threads, clocks
// or messages.
#pragma once

#include <algorithm>

#include "farm/scheduler/round.h"

namespace vitrail {

class Stall {
 public:
  explicit Stall(double patience_s) : patience_s_(patience_s) {}  // 0: never

  // Takes the sums of a round that has ended and decided nothing, at a time of the caller's clock. Returns
  // true where no worker and no loader of the job has had anything in hand in any round for `patience_s`.
  // Rays were neither born nor ended in that time.
  bool seen(const RoundSums& sums, double now_s) {
    const bool stands = sums.working == 0 && sums.born == born_ && sums.died == died_;
    // The job had no time to go on where this rank itself stood still.
    still_s_ = stands ? still_s_ + std::min(now_s - last_s_, patience_s_ / 8) : 0;
    born_ = sums.born, died_ = sums.died, last_s_ = now_s;
    return patience_s_ > 0 && still_s_ >= patience_s_;
  }

 private:
  double patience_s_;
  std::int64_t born_ = 0, died_ = 0;
  double last_s_ = 0, still_s_ = 0;
};

}  // namespace vitrail
