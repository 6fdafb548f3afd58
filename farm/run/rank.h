// SPDX-License-Identifier: Apache-2.0
// A Rank is one rank of a job, from the first ray to the last: the loop of the only thread that speaks to the
// transport.
#pragma once

#include "farm/plan/job.h"
#include "farm/run/checkpointing.h"
#include "farm/run/exchange.h"
#include "farm/run/phases.h"
#include "farm/run/progress.h"
#include "farm/run/settling.h"
#include "farm/scheduler/stall.h"

namespace vitrail {

class Rank {
 public:
  // All references outlive it.
  Rank(Transport& transport, RankState& state, const RenderOptions& options, Job& job, EarlierWork earlier);

  // Runs until the picture is whole, the time is up or the job is told to stop. Rank 0 has then written the
  // film, or a checkpoint where a signal stopped it. Ending::none says that homes are to settle, which all
  // ranks do together while no worker lives; after it `run` goes on (settle_homes.h). Throws what went wrong
  // here, or OtherRankFailed, after all ranks have agreed to end.
  Ending run();

  void add_to(RenderStats& stats) const;
  int rounds() const { return phases_.rounds(); }  // begun here

 private:
  enum class Decision { go_on, settle, pause, end };

  void join_round();
  std::optional<Ending> after_round(const Round& round);
  Decision decide(const Round& round);
  std::optional<Ending> act_on(Decision decision, const RoundSums& sums);
  std::optional<Ending> begin_next_round(Ending stop);
  void watch_settling(const RoundSums& sums);
  void record(const Locked& locked, bool wanted);
  void watch_for_stall(const RoundSums& sums);
  [[noreturn]] void leave_failed(const RoundSums& sums);
  Ending ending_of(const RoundSums& sums) const;

  Transport& transport_;
  RankState& state_;
  const RenderOptions& options_;
  const Goal& goal_;
  Progress progress_;
  Phases phases_;
  Exchange exchange_;
  Checkpointing checkpointing_;
  Settling settling_;
  Stall stall_;
  RankState::Clock::time_point last_counters_;
};

}  // namespace vitrail
