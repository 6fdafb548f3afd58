// SPDX-License-Identifier: Apache-2.0
// A Settling decides when a job whose homes nobody has planned records where its rays go, and when it settles
// homes by that record.
#pragma once

#include "farm/plan/job_plan.h"
#include "farm/scheduler/round.h"

namespace vitrail {

// Rank 0 decides it, once: a job that will end soon records nothing, and never pauses for it.
class Settling {
 public:
  Settling(const JobPlan& plan, const RenderOptions& options);

  // It holds what is known of a job at a round, on rank 0.
  struct Moment {
    double now_s = 0;          // since rendering began
    double samples_left = 0;   // of the goal, as far as is known
    double until_limit_s = 0;  // the time that --time leaves; infinite without it
    std::int64_t items_a_pass = 0;
  };
  void watch(const RoundSums& sums, const Moment& moment);

  // Returns whether tasks are to be recorded.
  bool profiles() const { return stage_ == Stage::profiles || stage_ == Stage::settles; }
  // Returns 1 once homes are to settle: no ray is born, and those that are alive show how much work each rank
  // has. It returns 2 where they take long: what is left of them goes to the new homes. Before it returns 0.
  int settles(double now_s) const;
  void is_over() { stage_ = Stage::over; }

 private:
  enum class Stage : std::uint8_t { waits, profiles, settles, over };

  double left_s(const RoundSums& sums, const Moment& moment) const;

  double wait_s_, profile_s_, worth_profiling_s_, worth_settling_s_, ending_s_;
  std::int64_t rays_;  // that a profile needs
  Stage stage_;
  double since_s_ = 0;     // when it began to record
  double settles_s_ = 0;   // when homes were to settle
  double ended_then_ = 0;  // samples
  std::int64_t items_then_ = 0, rays_then_ = 0;
};

}  // namespace vitrail
