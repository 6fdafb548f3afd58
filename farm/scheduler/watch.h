// SPDX-License-Identifier: Apache-2.0
// Watch finds who has stopped answering. A round ends when all ranks have joined it, so one that hangs is
// missed by all and known to none: ranks that have waited long ask. Watch, like the scheduler, has no
// threads, clocks or messages.
#pragma once

#include <vector>

namespace vitrail {

// It is the watch of one rank. The first two ranks ask, so that each of them is missed by the other; where
// both are silent the others end without having been asked. Seconds are of the caller's clock.
class Watch {
 public:
  static constexpr int asking_ranks = 2;

  // A rank that does not answer is named once a round has stood for `patience_s`, and none that answers
  // within half of that ever is. A patience of 0 is without end.
  Watch(int rank, int ranks, double patience_s);

  // These are the events.
  void round_begins(double now_s);  // this rank joined it
  void round_ends() { waiting_ = false; }
  void asked(double now_s) { heard_s_ = now_s; }  // and is to answer at once, whatever else it does
  void answered(int rank);

  enum class Step { nothing, ask_all, give_up };
  Step step(double now_s);
  double due_s() const;             // when `step` may have something next; ∞: not before another event
  std::vector<int> silent() const;  // ascending, when it gives up

 private:
  bool asks() const { return rank_ < asking_ranks; }
  double stands_until_s() const;

  int rank_, ranks_;
  double patience_s_;
  bool waiting_ = false;  // in a round
  bool asking_ = false;
  double since_s_ = 0;          // that a round stands and all were well
  double heard_s_ = 0;          // of a rank that asks
  double asked_s_ = 0;          // when this one did
  std::vector<bool> answered_;  // by rank
  int missing_ = 0;             // answers
};

}  // namespace vitrail
